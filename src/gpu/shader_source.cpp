#include "gpu/shader_source.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <sstream>

#include "core/file.h"
#include "gpu/array_table.h"
#include "gpu/conditions.h"

namespace shoal::gpu {

bool isIdentifier(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

namespace {

std::string_view withoutSpaces(std::string_view text) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
        text.remove_prefix(1);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.remove_suffix(1);
    return text;
}

// Calls visit(line) for each line, without its end; a text that ends in a newline has no empty last line.
template <typename Visit>
void forEachLine(std::string_view text, Visit visit) {
    while (!text.empty()) {
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
        visit(line);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
}

// The line with spaces in place of comments, which keeps its columns, and none at its end. `inside`: a block
// comment.
std::string withoutComments(std::string_view line, bool& inside) {
    std::string out;
    while (!line.empty()) {
        const std::string_view start = line.substr(0, 2);
        if (!inside && start == "//") break;
        const bool begins = !inside && start == "/*", ends = inside && start == "*/";
        if (begins || inside)
            out.append(begins || ends ? 2 : 1, ' ');
        else
            out += line.front();
        line.remove_prefix(begins || ends ? 2 : 1);
        inside = begins || (inside && !ends);
    }
    out.resize(out.find_last_not_of(" \t") + 1);
    return out;
}

// A directive such as "#include", with spaces where C allows them; sets `rest` to what follows.
bool isDirective(std::string_view line, std::string_view word, std::string_view& rest) {
    line = withoutSpaces(line);
    if (line.empty() || line.front() != '#') return false;
    line = withoutSpaces(line.substr(1));
    if (line.substr(0, word.size()) != word) return false;
    rest = line.substr(word.size());
    if (!rest.empty() && isIdentifier(rest.front())) return false;
    rest = withoutSpaces(rest);
    return true;
}

class Resolver {
  public:
    Resolver(const std::string& root, const std::map<std::string, std::string>& generated,
             const ArrayTable* arrays)
        : root_(root), generated_(generated), arrays_(arrays) {
        if (arrays) declarations_.emplace(*arrays);
    }

    int addFile(const std::string& name) {
        source.files.push_back(name);
        return static_cast<int>(source.files.size()) - 1;
    }
    // Adds a line, unless it is blank or a condition leaves it out.
    void addLine(std::string_view line, int file, int number) {
        if (line.empty()) return;
        const bool stays = conditions_.stays(line, {source.files[size_t(file)], number, 0, {}});
        (stays ? source.text : source.leftOut).append(line) += '\n';
        if (stays) source.lines.push_back({file, number});
    }

    // `asker`: where the #include is; empty for the file that the program names.
    void add(const std::string& name, const Location& asker) {
        if (!included_.insert(name).second) return;
        const auto virtualFile = generated_.find(name);
        const bool onDisk = virtualFile == generated_.end();
        const std::string shown =
            onDisk ? (std::filesystem::path(root_) / name).string() : "generated:" + name;
        const std::string text = onDisk ? read(name, shown, asker) : virtualFile->second;
        const int file = addFile(shown);
        int number = 0;
        bool inComment = false;
        const size_t depth = conditions_.depth();
        forEachLine(text, [&](std::string_view commented) {
            ++number;
            const std::string line = withoutComments(commented, inComment);
            std::string_view rest;
            const Location here{shown, number, static_cast<int>(line.find('#')) + 1, {}};
            if (isDirective(line, "include", rest)) {
                const std::string asked = quoted(rest, here);
                if (conditions_.taken()) add(asked, here);
            } else if (declarations_ && isDirective(line, "pragma", rest)) {
                if (conditions_.taken()) declare(rest, file, here);
            } else {
                addLine(line, file, number);
            }
        });
        conditions_.needClosed(depth);
    }

    ShaderSource source;

  private:
    // Puts what a pragma names of arrays in its place.
    void declare(std::string_view rest, int file, const Location& here) {
        for (const std::string& include : arrays_->includes())
            add(include, here);
        std::istringstream words{std::string(rest)};
        std::string verb;
        words >> verb;
        std::vector<std::string> names;
        for (std::string name; words >> name;)
            names.push_back(name);
        forEachLine(declarations_->declare(verb, names, here),
                    [&](std::string_view line) { addLine(line, file, here.line); });
        source.written = declarations_->written();
        source.updated = declarations_->updated();
    }

    static std::string quoted(std::string_view rest, const Location& where) {
        const size_t end =
            rest.size() > 1 && rest.front() == '"' ? rest.find('"', 1) : std::string_view::npos;
        if (end == std::string_view::npos || end == 1 || end + 1 < rest.size())
            throw Error(where, "expected #include \"folder/file.glsl\", from the root of the shaders");
        return std::string(rest.substr(1, end - 1));
    }

    std::string read(const std::string& name, const std::string& shown, const Location& asker) const {
        std::error_code ignored;
        if (std::filesystem::is_regular_file(shown, ignored)) return readFile(shown);
        throw Error(asker, concat("there is no shader file \"", name, "\" below ", root_, didYouMean(name)));
    }

    // A misspelt name is often near to one in the same folder.
    std::string didYouMean(const std::string& name) const {
        const std::filesystem::path folder = std::filesystem::path(name).parent_path();
        std::vector<std::string> candidates;
        std::error_code error;
        for (std::filesystem::directory_iterator entry(std::filesystem::path(root_) / folder, error), end;
             !error && entry != end; entry.increment(error)) {
            candidates.push_back((folder / entry->path().filename()).generic_string());
        }
        for (const auto& [virtualName, text] : generated_)
            candidates.push_back(virtualName);
        const std::string near = nearest(name, candidates);
        return near.empty() ? "" : " (did you mean \"" + near + "\"?)";
    }

    std::string root_;
    const std::map<std::string, std::string>& generated_;
    const ArrayTable* arrays_;
    std::optional<ArrayDeclarations> declarations_;
    std::set<std::string> included_;
    Conditions conditions_;
};

// One message of a driver: the line of the text it points to, and where its words begin.
struct DriverMessage {
    int line = 0, column = 0;
    std::string prefix;
    size_t rest = 0;
};

bool parseMessage(const std::string& line, DriverMessage& out) {
    int string = 0, consumed = 0;
    const char* text = line.c_str();
    out = {};
    if (std::sscanf(text, "%d:%d(%d): %n", &string, &out.line, &out.column, &consumed) == 3 && consumed > 0) {
        out.rest = static_cast<size_t>(consumed);  // Mesa
        return true;
    }
    out.column = 0;
    if (std::sscanf(text, "%d(%d) : %n", &string, &out.line, &consumed) == 2 && consumed > 0) {
        out.rest = static_cast<size_t>(consumed);  // NVIDIA
        return true;
    }
    if (std::sscanf(text, "ERROR: %d:%d: %n", &string, &out.line, &consumed) == 2 && consumed > 0) {
        out.prefix = "error: ";  // Intel, AMD, Apple
    } else if (std::sscanf(text, "WARNING: %d:%d: %n", &string, &out.line, &consumed) == 2 && consumed > 0) {
        out.prefix = "warning: ";
    }
    out.rest = static_cast<size_t>(consumed);
    return consumed > 0;
}

bool locate(const ShaderSource& source, const std::string& line, DriverMessage& message, Location& out) {
    if (!parseMessage(line, message)) return false;
    if (message.line < 1 || static_cast<size_t>(message.line) > source.lines.size()) return false;
    const ShaderSource::Line& origin = source.lines[static_cast<size_t>(message.line) - 1];
    out = {source.files[static_cast<size_t>(origin.file)], origin.line, message.column, {}};
    return true;
}

}  // namespace

std::string ShaderSource::rewriteLog(const std::string& driverLog) const {
    std::string out;
    forEachLine(driverLog, [&](std::string_view view) {
        const std::string line(view);
        DriverMessage message;
        Location place;
        if (!out.empty()) out += '\n';
        out += locate(*this, line, message, place)
                   ? prefix(place) + message.prefix + line.substr(message.rest)
                   : line;
    });
    return out;
}

Location ShaderSource::firstLocation(const std::string& driverLog) const {
    Location first, firstError;
    forEachLine(driverLog, [&](std::string_view view) {
        const std::string line(view);
        DriverMessage message;
        Location place;
        if (!locate(*this, line, message, place)) return;
        const bool error = (message.prefix + line.substr(message.rest)).compare(0, 5, "error") == 0;
        if (first.empty()) first = place;
        if (error && firstError.empty()) firstError = place;
    });
    return firstError.empty() ? first : firstError;
}

ShaderSource resolveShader(const std::string& root, const std::string& file,
                           const std::vector<std::string>& defines,
                           const std::map<std::string, std::string>& generated, const std::string& header,
                           const ArrayTable* arrays) {
    Resolver resolver(root, generated, arrays);
    int number = 0;
    const int headerFile = resolver.addFile("shader header");
    forEachLine(header, [&](std::string_view line) { resolver.addLine(line, headerFile, ++number); });
    for (const std::string& define : defines)
        resolver.addLine(define[0] == '#' ? define : "#define " + define, headerFile, ++number);
    resolver.add(file, {});
    return std::move(resolver.source);
}

std::string constant(const std::string& name, bool value) {
    return concat(name, value ? " true" : " false");
}

std::string requireExtension(const std::string& name) {
    return concat("#extension ", name, " : require");
}

const char* header330() {
    return "#version 330 core\n";
}

const char* header430() {
    return "#version 430 core\n";
}

std::set<std::string, std::less<>> declared(std::string_view text, std::string_view keyword) {
    std::set<std::string, std::less<>> out;
    bool inDeclaration = false;
    int depth = 0;  // of braces, inside a block
    for (size_t i = 0; i < text.size();) {
        const std::string_view rest = text.substr(i);
        if (isIdentifier(rest.front())) {
            size_t length = 1;
            while (length < rest.size() && isIdentifier(rest[length]))
                ++length;
            const std::string_view word = rest.substr(0, length);
            // Types and precisions come along; they are no names that anybody would set.
            if (inDeclaration) out.insert(std::string(word));
            if (word == keyword) inDeclaration = true;
            i += length;
        } else {
            if (rest.front() == '{' && inDeclaration) ++depth;
            if (rest.front() == '}' && inDeclaration) --depth;
            if (rest.front() == ';' && depth <= 0) inDeclaration = false;
            ++i;
        }
    }
    return out;
}

}  // namespace shoal::gpu
