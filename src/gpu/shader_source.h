// Shader files with includes, and a line table; comments, blank lines and conditions (gpu/conditions.h) are
// taken out, so that rewording a comment compiles nothing anew. Pure text: no OpenGL, testable without a
// context.
//
// Shader files have no #version line: `header` goes in front, then one #define a line, then the file with
// every #include "folder/file.glsl" that is used replaced by that file, once each, from the root of the
// shaders. An #include in a branch that is left out is none. There is no #line in the result, because drivers
// disagree on what it means; instead the driver's log is rewritten with the table.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace shoal::gpu {

class ArrayTable;

struct ShaderSource {
    struct Line {
        int file = 0;  // index into `files`
        int line = 0;  // from 1
    };
    std::string text;
    std::string leftOut;               // by conditions: what this declares may be set, to no effect
    std::vector<Line> lines;           // one for each line of `text`
    std::vector<std::string> files;    // as they are named in messages; [0] is the header
    std::vector<std::string> written;  // arrays, in the order in which they are named
    std::vector<std::string> updated;  // those of them that are read as well

    // Every "0:12(5): error:" (Mesa), "0(12) : error" (NVIDIA) and "ERROR: 0:12:" (Intel, AMD, Apple) becomes
    // "file:line[:column]: …"; other lines stay as they are.
    std::string rewriteLog(const std::string& driverLog) const;
    // Returns the place that the first error of the log points to, else that of its first message; empty when
    // none points anywhere.
    Location firstLocation(const std::string& driverLog) const;
};

// `defines`: "NAME", "NAME value" or requireExtension(). `generated`: files that exist only in memory, by the
// name they are included under; they go before files on disk, `file` itself among them. `arrays`: what
// #pragma reads, writes and updates name (gpu/array_table.h), or null. Error, located: no such file; a
// condition that Conditions does not know; no such array.
ShaderSource resolveShader(const std::string& root, const std::string& file,
                           const std::vector<std::string>& defines,
                           const std::map<std::string, std::string>& generated, const std::string& header,
                           const ArrayTable* arrays = nullptr);

// A define, true or false, that an ordinary `if` asks for: its branch that is never taken is read by the
// compiler, so that a misspelt name is an error, and folded away.
std::string constant(const std::string& name, bool value);

// An extension that the shader needs, among its defines.
std::string requireExtension(const std::string& name);

const char* header330();  // #version 330 core
const char* header430();  // #version 430 core, the first with compute shaders

// Names that a text without comments declares by a keyword, "uniform" or "buffer", whether or not the
// compiler will keep them: every word up to the end of the declaration. Blocks count with their own name and
// those of their members.
std::set<std::string, std::less<>> declared(std::string_view text, std::string_view keyword);
bool isIdentifier(char c);  // a letter, a digit or _

}  // namespace shoal::gpu
