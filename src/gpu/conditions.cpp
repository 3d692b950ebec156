#include "gpu/shader_source.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace shoal::gpu {
namespace {

// Words, and the signs ! ( ) && ||, of a condition or directive; a comment ends it.
std::vector<std::string> tokensOf(std::string_view text) {
    std::vector<std::string> out;
    for (size_t i = 0; i < text.size();) {
        if (text.substr(i, 2) == "//") break;
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

class Resolver {
  public:
    explicit Resolver(ShaderSource& source) : source_(source) {}

    void go() {
        std::istringstream lines(source_.text);
        const std::vector<ShaderSource::Line> origins = std::move(source_.lines);
        source_.text.clear();
        source_.lines.clear();
        std::string line;
        for (const ShaderSource::Line& origin : origins) {
            std::getline(lines, line);
            where_ = {source_.files[static_cast<size_t>(origin.file)], origin.line, 0, {}};
            if (directive(line) || !taken()) continue;
            // what was taken out leaves no gaps
            if (line.find_first_not_of(' ') == std::string::npos && blank_) continue;
            blank_ = line.find_first_not_of(' ') == std::string::npos;
            source_.text += line + "\n";
            source_.lines.push_back(origin);
        }
        if (!open_.empty()) throw Error(open_.back().where, "#if without #endif");
    }

  private:
    struct Branch {
        bool now, done;  // taken; some branch of this #if was
        Location where;
    };

    bool taken() const {
        return std::all_of(open_.begin(), open_.end(), [](const Branch& branch) { return branch.now; });
    }

    // Whether the line is one that goes.
    bool directive(const std::string& line) {
        const size_t start = line.find_first_not_of(' ');
        if (start == std::string::npos || line[start] != '#') return false;
        std::vector<std::string> words = tokensOf(std::string_view(line).substr(start + 1));
        if (words.empty()) return false;
        const std::string word = words.front();
        words.erase(words.begin());
        if (word == "ifdef" || word == "ifndef") {
            need(words.size() == 1);
            open((defined_.count(words[0]) == 1) == (word == "ifdef"));
        } else if (word == "if") {
            open(either(words));
        } else if (word == "else") {
            need(!open_.empty());
            open_.back().now = !open_.back().done;
            open_.back().done = true;
        } else if (word == "endif") {
            need(!open_.empty());
            open_.pop_back();
        } else if (word == "define" && taken()) {
            need(!words.empty());
            defined_.insert(words[0]);
            return words.size() == 1;
        } else if (word == "undef" && taken()) {
            need(words.size() == 1);
            defined_.erase(words[0]);
        } else {
            need(word != "elif");
            return false;
        }
        return true;
    }

    void open(bool condition) { open_.push_back({condition, condition, where_}); }

    // a && b || c, from the left as C has it
    bool either(const std::vector<std::string>& words) const {
        bool any = false, all = true;
        size_t i = 0;
        for (;;) {
            bool wanted = true;
            for (; i < words.size() && words[i] == "!"; ++i)
                wanted = !wanted;
            need(i + 3 < words.size() && words[i] == "defined" && words[i + 1] == "(" && words[i + 3] == ")");
            all = all && (defined_.count(words[i + 2]) == 1) == wanted;
            i += 4;
            if (i == words.size()) return any || all;
            need(words[i] == "&&" || words[i] == "||");
            if (words[i] == "||") {
                any = any || all;
                all = true;
            }
            ++i;
        }
    }

    void need(bool understood) const {
        if (!understood) throw Error(where_, "a directive of a form that this shader may not use");
    }

    ShaderSource& source_;
    std::set<std::string> defined_;
    std::vector<Branch> open_;
    Location where_;
    bool blank_ = false;  // the last line that stayed
};

}  // namespace

void resolveConditions(ShaderSource& source) {
    Resolver(source).go();
}

}  // namespace shoal::gpu
