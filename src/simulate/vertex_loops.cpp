#include "simulate/vertex_loops.h"

#include <algorithm>
#include <cctype>

#include "core/contract.h"

namespace shoal {

namespace {

using Form = VertexLoops::Form;

bool isWordCharacter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// The line with every word `name` replaced.
std::string withWord(const std::string& line, char name, const std::string& value) {
    std::string out;
    for (size_t k = 0; k < line.size(); ++k) {
        const bool alone = line[k] == name &&
                           (k == 0 || (!isWordCharacter(line[k - 1]) && line[k - 1] != '.')) &&
                           (k + 1 == line.size() || !isWordCharacter(line[k + 1]));
        if (alone)
            out += value;
        else
            out += line[k];
    }
    return out;
}

struct Line {
    std::string text;
    gpu::ShaderSource::Line origin;
};

std::vector<Line> linesOf(const gpu::ShaderSource& source) {
    std::vector<Line> lines;
    size_t start = 0;
    for (const gpu::ShaderSource::Line& origin : source.lines) {
        const size_t end = source.text.find('\n', start);
        lines.push_back({source.text.substr(start, end - start), origin});
        start = end + 1;
    }
    return lines;
}

// The variable of a loop over the vertices that the line opens, else 0.
char loopVariable(const std::string& line) {
    const size_t start = line.find_first_not_of(' ');
    if (start == std::string::npos) return 0;
    for (const char name : {'i', 'j', 'k', 'n'}) {
        const std::string n(1, name);
        if (line.compare(start, std::string::npos,
                         "for (int " + n + " = 0; " + n + " < VERTICES; ++" + n + ") {") == 0)
            return name;
    }
    return 0;
}

// Index of the line that closes the block which line `open` opens.
size_t closingLine(const std::vector<Line>& lines, size_t open) {
    int depth = 0;
    for (size_t k = open; k < lines.size(); ++k) {
        const std::string& code = lines[k].text;
        depth +=
            int(std::count(code.begin(), code.end(), '{')) - int(std::count(code.begin(), code.end(), '}'));
        if (depth == 0) return k;
    }
    EXPECTS(false && "a loop over vertices does not end");
    return lines.size() - 1;
}

class Expander {
  public:
    Expander(gpu::ShaderSource& source, const VertexLoops& loops)
        : source_(source), loops_(loops), lines_(linesOf(source)) {
        source_.text.clear();
        source_.lines.clear();
    }

    void go() {
        for (size_t k = 0; k < lines_.size(); ++k) {
            const char variable = loopVariable(lines_[k].text);
            const Form form = variable == 'i'   ? loops_.shortBodies
                              : variable == 'j' ? loops_.fields
                              : variable == 'k' ? loops_.contacts
                                                : loops_.touches;
            if (variable == 0 || form == Form::keep) {
                add(lines_[k].text, lines_[k].origin);
            } else {
                const size_t end = closingLine(lines_, k);
                writeOut(variable, k, end);
                k = end;
            }
        }
    }

  private:
    void writeOut(char variable, size_t open, size_t end) {
        // #if inside the body is repeated with it; what a body declares stays its own
        const bool declares = end - open > 2;
        const std::string indent(lines_[open].text.find_first_not_of(' '), ' ');
        for (int vertex = 0; vertex < loops_.vertexCount; ++vertex) {
            if (declares) add(indent + "{", lines_[open].origin);
            for (size_t k = open + 1; k < end; ++k) {
                const std::string& text = lines_[k].text;
                const size_t drop = !declares && text.compare(0, 4, "    ") == 0 ? 4 : 0;
                add(withWord(text.substr(drop), variable, std::to_string(vertex)), lines_[k].origin);
            }
            if (declares) add(indent + "}", lines_[end].origin);
        }
    }

    void add(const std::string& text, const gpu::ShaderSource::Line& origin) {
        source_.text += text;
        source_.text += '\n';
        source_.lines.push_back(origin);
    }

    gpu::ShaderSource& source_;
    const VertexLoops& loops_;
    std::vector<Line> lines_;
};

}  // namespace

void expand(gpu::ShaderSource& source, const VertexLoops& loops) {
    Expander(source, loops).go();
}

}  // namespace shoal
