// The conditions of a shader's text, taken out as it is read, so that people read, and drivers compile, only
// what is used.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace shoal::gpu {

// Follows #if, #ifdef, #ifndef, #elif, #else and #endif from line to line.
//
// A condition joins with && and || terms of the form defined(NAME), !defined(NAME) and NAME > NUMBER, without
// brackets. A name counts as defined from its #define on, whatever driver or language defines by itself is
// unknown. What is defined as true or false is a constant, for an ordinary if. Error, located: a condition of
// another form, or of such a constant.
class Conditions {
  public:
    // Whether the current line is in no branch that is left out.
    bool taken() const;
    // Takes the next line, which is no #include; returns whether it stays in the text. Directives go, defines
    // without a value among them.
    bool stays(std::string_view line, const Location& where);
    // Error: an #if that was opened below `depth` others and has no #endif.
    void needClosed(size_t depth) const;
    size_t depth() const { return open_.size(); }

  private:
    struct Branch {
        bool taken, done;  // done: some branch of this #if was taken
        Location where;
    };

    bool directive(const std::string& word, const std::vector<std::string>& words, const Location& where);
    bool isDefined(const std::string& name, const Location& where) const;
    bool holds(const std::vector<std::string>& words, const Location& where) const;

    std::map<std::string, std::string> defined_;  // and their values
    std::vector<Branch> open_;
};

}  // namespace shoal::gpu
