// The program as a child process, in a directory of its own.
#pragma once

#include "polylab/io.h"
#include "polylab/text.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace polylab {

struct Result {
    int status;
    std::string out, err;
};

// A new, empty directory in which the program runs; it goes away with its content.
class Scratch {
public:
    Scratch() {
        std::filesystem::remove_all(at_);
        std::filesystem::create_directories(at_);
        write("cube.obj", obj_text(shapes::cube(1)));
        write("naive.txt", "0 0 1 1 2 2 3 3 4 4 5 5\n");
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(at_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    std::string path(const std::string& name) const { return (at_ / name).string(); }
    void write(const std::string& name, const std::string& content) const { write_file(path(name), content); }
    std::string read(const std::string& name) const { return read_file(path(name)); }
    bool has(const std::string& name) const { return std::filesystem::exists(at_ / name); }
    std::size_t entries() const { return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(at_), {})); }

    // `polylab ARGUMENTS`, as words of the shell, after the commands `before`; redirections that they hold win.
    Result run(const std::string& arguments, const std::string& before = "", const std::string& program = POLYLAB_PROGRAM) const {
        const std::string out = path("") + "../out." + pid(), err = path("") + "../err." + pid();
        const std::string command = "cd '" + at_.string() + "' && { " + before + "'" + program + "' " + arguments +
                                    "\n} </dev/null >'" + out + "' 2>'" + err + "'";
        const int status = std::system(command.c_str());
        const Result result = {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        return result;
    }

private:
    static std::string pid() { return std::to_string(::getpid()); }

    std::filesystem::path at_ = std::filesystem::path(POLYLAB_BUILD_DIR) / ("scratch." + pid());
};

// No result: status 2, one line of error, nothing else, and no file that was not there.
inline void check_refused(const Scratch& scratch, const std::string& arguments, const std::string& message) {
    CAPTURE(arguments);
    const std::size_t before = scratch.entries();
    const Result r = scratch.run(arguments);
    CHECK(r.status == 2);
    CHECK(r.out.empty());
    CAPTURE(r.err);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK(r.err.find(message) != std::string::npos);
    CHECK(scratch.entries() == before);
}

inline Result check_done(const Scratch& scratch, const std::string& arguments, int status = 0) {
    CAPTURE(arguments);
    const Result r = scratch.run(arguments);
    CHECK(r.status == status);
    CHECK(r.err.empty());
    return r;
}

}   // namespace polylab
