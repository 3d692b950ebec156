#include "gpu/conditions.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "gpu/shader_source.h"

namespace shoal::gpu {
namespace {

// Words, and the signs ! ( ) > && ||, of a condition or directive.
std::vector<std::string> tokensOf(std::string_view text) {
    std::vector<std::string> out;
    for (size_t i = 0; i < text.size();) {
        if (isIdentifier(text[i])) {
            size_t end = i;
            while (end < text.size() && isIdentifier(text[end]))
                ++end;
            out.emplace_back(text.substr(i, end - i));
            i = end;
        } else if (text.substr(i, 2) == "&&" || text.substr(i, 2) == "||") {
            out.emplace_back(text.substr(i, 2));
            i += 2;
        } else {
            if (std::isspace(static_cast<unsigned char>(text[i])) == 0) out.emplace_back(1, text[i]);
            ++i;
        }
    }
    return out;
}

void need(bool understood, const Location& where) {
    if (!understood) throw Error(where, "a directive of a form that this shader may not use");
}

}  // namespace

bool Conditions::taken() const {
    return std::all_of(open_.begin(), open_.end(), [](const Branch& branch) { return branch.taken; });
}

bool Conditions::stays(std::string_view line, const Location& where) {
    const size_t start = line.find_first_not_of(" \t");
    if (start == std::string_view::npos || line[start] != '#') return taken();
    std::vector<std::string> words = tokensOf(line.substr(start + 1));
    if (words.empty()) return taken();
    const std::string word = words.front();
    words.erase(words.begin());
    return !directive(word, words, where) && taken();
}

void Conditions::needClosed(size_t depth) const {
    if (open_.size() > depth) throw Error(open_.back().where, "#if without #endif");
}

// Returns whether the line goes.
bool Conditions::directive(const std::string& word, const std::vector<std::string>& words,
                           const Location& where) {
    const auto open = [&](bool condition) { open_.push_back({condition, condition, where}); };
    if (word == "ifdef" || word == "ifndef") {
        need(words.size() == 1, where);
        open(isDefined(words[0], where) == (word == "ifdef"));
    } else if (word == "if") {
        open(holds(words, where));
    } else if (word == "elif" || word == "else") {
        need(!open_.empty(), where);
        Branch& branch = open_.back();
        branch.taken = !branch.done && (word == "else" || holds(words, where));
        branch.done = branch.done || branch.taken;
    } else if (word == "endif") {
        need(!open_.empty(), where);
        open_.pop_back();
    } else if (word == "define" && taken()) {
        need(!words.empty(), where);
        defined_[words[0]] = words.size() > 1 ? words[1] : "";
        return words.size() == 1;
    } else if (word == "undef" && taken()) {
        need(words.size() == 1, where);
        defined_.erase(words[0]);
        return false;
    } else {
        return false;
    }
    return true;
}

bool Conditions::isDefined(const std::string& name, const Location& where) const {
    const auto found = defined_.find(name);
    if (found == defined_.end()) return false;
    if (found->second == "true" || found->second == "false")
        throw Error(where, concat(name, " is a constant, true or false: an ordinary if asks for it"));
    return true;
}

// Reads a && b || c from the left, as C has it.
bool Conditions::holds(const std::vector<std::string>& words, const Location& where) const {
    bool any = false, all = true;
    size_t i = 0;
    const auto isWord = [&](size_t ahead, const char* word) {
        return i + ahead < words.size() && words[i + ahead] == word;
    };
    for (;;) {
        bool wanted = true;
        for (; isWord(0, "!"); ++i)
            wanted = !wanted;
        bool term = false;
        if (isWord(0, "defined") && isWord(1, "(") && isWord(3, ")")) {
            term = isDefined(words[i + 2], where);
            i += 4;
        } else {
            need(isWord(1, ">") && i + 2 < words.size() && defined_.count(words[i]) == 1, where);
            term = std::atoi(defined_.at(words[i]).c_str()) > std::atoi(words[i + 2].c_str());
            i += 3;
        }
        all = all && term == wanted;
        if (i == words.size()) return any || all;
        need(isWord(0, "&&") || isWord(0, "||"), where);
        if (isWord(0, "||")) {
            any = any || all;
            all = true;
        }
        ++i;
    }
}

}  // namespace shoal::gpu
