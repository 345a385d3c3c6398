// cli.h: command-line arguments from one table that is also the help text.
#pragma once

#include "polylab/base.h"

#include <map>
#include <string>
#include <vector>

namespace polylab {

struct Option {
    std::string name;    // "--method" or "-o"
    std::string value;   // what stands for its value in the help; empty for a switch
    std::string help;
};

struct Arguments {
    std::vector<std::string> operands;
    std::map<std::string, std::string> options;   // name -> value, as given

    bool has(const std::string& name) const { return options.count(name) > 0; }
    std::string get(const std::string& name, const std::string& otherwise = "") const;
    // Numbers within a range; UsageError `--name: expected …, found …` otherwise.
    int integer(const std::string& name, int otherwise, int least, int most) const;
    double number(const std::string& name, double otherwise, double least, double most) const;
};

struct Command {
    std::string name;
    std::vector<std::string> operands;
    std::string about;   // one sentence, then details
    std::vector<Option> options;
    int (*run)(const Arguments&) = nullptr;   // returns the exit status
    // Lines of the help.
    std::string status;     // what each exit status means
    std::string files;      // what the operands hold
    std::string examples;   // command lines
};

// Wrong use of the command line: the message, to be followed by where the help is.
class UsageError : public InputError {
public:
    using InputError::InputError;
};

// `-o X`, `--name X`, `--name=X`; a lone `-` is an operand; `--` ends the options. Throws UsageError.
Arguments parse_arguments(const Command& command, const std::vector<std::string>& words);

// The page of a command, as `man` lays one out: sections that are empty are left out.
std::string help(const std::string& program, const Command& command);

}   // namespace polylab
