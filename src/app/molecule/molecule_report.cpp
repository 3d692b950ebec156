// `shoal molecule from-mesh --report FILE.html`: what was made, on one page that needs no other file.
#include <string>

#include "app/line/commands.h"
#include "app/molecule/molecule_report.h"
#include "core/error.h"
#include "core/file.h"
#include "core/image.h"

namespace shoal::app {

// RFC 4648.
static std::string base64(const std::vector<std::byte>& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t three = 0;
        for (size_t k = 0; k < 3; ++k)
            three = three << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0);
        for (size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
    return out;
}

static std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

void writeMoleculeReport(const Options& options, const Molecule& molecule, const std::string& text) {
    gpu::Context context(hiddenContext(options));
    constexpr int width = 1280, height = 760;
    const Image sheet = moleculeSheet(context, molecule, width, height);
    const std::string title = escaped(molecule.name);
    writeFile(
        options.molecule.report,
        concat("<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>", title,
               "</title>\n<style>body { font: 16px/1.5 sans-serif; max-width: 1280px; margin: 2em auto; "
               "padding: 0 1em } img { max-width: 100% } pre { white-space: pre-wrap }</style>\n<h1>",
               title, "</h1>\n<img alt=\"the molecule and its motions\" src=\"data:image/png;base64,",
               base64(encodePng(sheet)),
               "\">\n<p>At the left the rest shape: springs, normals of triangles, vertices as dots, pinned "
               "ones as squares. At the right its slowest motions, drawn large: springs that grow "
               "longer are red, shorter ones blue.</p>\n<pre>",
               escaped(text), "</pre>\n</html>\n"));
}

}  // namespace shoal::app
