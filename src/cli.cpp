#include "polylab/cli.h"

#include "polylab/text.h"

#include <algorithm>

namespace polylab {

std::string Arguments::get(const std::string& name, const std::string& otherwise) const {
    const auto found = options.find(name);
    return found == options.end() ? otherwise : found->second;
}

namespace {

[[noreturn]] void refuse_number(const std::string& name, const std::string& expected, const std::string& text) {
    throw UsageError(name + ": expected " + expected + ", found '" + text + "'");
}

}   // namespace

int Arguments::integer(const std::string& name, int otherwise, int least, int most) const {
    if (!has(name)) return otherwise;
    const std::string text = get(name), range = "an integer from " + std::to_string(least) + " to " + std::to_string(most);
    try {
        const int i = Scanner(text, name).to_integer(text, range.c_str());
        if (i >= least && i <= most) return i;
    } catch (const InputError&) {}
    refuse_number(name, range, text);
}

double Arguments::number(const std::string& name, double otherwise, double least, double most) const {
    if (!has(name)) return otherwise;
    std::string range = "a number from ";
    append(range, least);
    range += " to ";
    append(range, most);
    const std::string text = get(name);
    try {
        const double x = Scanner(text, name).to_number(text, range.c_str());
        if (x >= least && x <= most) return x;
    } catch (const InputError&) {}
    refuse_number(name, range, text);
}

Arguments parse_arguments(const Command& command, const std::vector<std::string>& words) {
    Arguments arguments;
    bool options_over = false;
    for (std::size_t i = 0; i < words.size(); i++) {
        const std::string& word = words[i];
        if (options_over || word.size() < 2 || word[0] != '-') {
            arguments.operands.push_back(word);
            continue;
        }
        if (word == "--") {
            options_over = true;
            continue;
        }
        const std::size_t equal = word.rfind("--", 0) == 0 ? word.find('=') : std::string::npos;
        const std::string name = word.substr(0, equal);
        const auto option =
            std::find_if(command.options.begin(), command.options.end(), [&](const Option& o) { return o.name == name; });
        if (option == command.options.end()) throw UsageError("unknown option " + name);
        if (arguments.has(name)) throw UsageError("option " + name + " is given twice");
        if (option->value.empty()) {
            if (equal != std::string::npos) throw UsageError("option " + name + " takes no value");
            arguments.options[name] = "";
        } else if (equal != std::string::npos) {
            arguments.options[name] = word.substr(equal + 1);
        } else if (i + 1 < words.size()) {
            arguments.options[name] = words[++i];
        } else {
            throw UsageError("option " + name + " needs a value: " + option->value);
        }
    }
    if (arguments.operands.size() < command.operands.size())
        throw UsageError("missing " + command.operands[arguments.operands.size()]);
    if (arguments.operands.size() > command.operands.size())
        throw UsageError("unexpected '" + arguments.operands[command.operands.size()] + "'");
    return arguments;
}

namespace {

std::string indented(const std::string& lines, std::size_t columns) {
    std::string text;
    bool fresh = true;   // nothing in this line yet
    for (const char c : lines) {
        if (fresh && c != '\n') text.append(columns, ' ');
        text += c;
        fresh = c == '\n';
    }
    return text + '\n';
}

std::string section(const char* title, const std::string& lines) {
    return lines.empty() ? "" : std::string("\n") + title + "\n" + indented(lines, 4);
}

}   // namespace

std::string help(const std::string& program, const Command& command) {
    std::string synopsis = program + " " + command.name;
    for (const std::string& operand : command.operands) synopsis += " " + operand;
    if (!command.options.empty()) synopsis += " [options]";
    const std::size_t end = command.about.find('\n');
    const std::string name = program + " " + command.name + ": " + command.about.substr(0, end);
    const std::string details = end == std::string::npos ? "" : command.about.substr(command.about.find_first_not_of('\n', end));
    std::string text = "NAME\n" + indented(name, 4) + section("SYNOPSIS", synopsis) + section("DESCRIPTION", details);
    std::size_t width = 0;
    for (const Option& o : command.options) width = std::max(width, o.name.size() + o.value.size() + 1);
    if (!command.options.empty()) text += "\nOPTIONS\n";
    for (const Option& o : command.options) {
        const std::string head = "    " + o.name + (o.value.empty() ? "" : " " + o.value);
        text += head + indented(o.help, width + 6).substr(head.size());
    }
    return text + section("EXIT STATUS", command.status) + section("FILES", command.files) +
           section("EXAMPLES", command.examples);
}

}   // namespace polylab
