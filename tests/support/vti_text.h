// A .vti file in any of the encodings, written by the test itself.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <zlib.h>

#include <glm/glm.hpp>

#include "core/error.h"

namespace shoal::test {

struct VtiText {
    enum class Format { ascii, binary, appendedRaw, appendedBase64 };
    Format format = Format::ascii;
    bool bigEndian = false, longHeader = false, zlib = false, wide = false;  // Float64
    bool ofCells = false;
    glm::ivec3 extent{2, 1, 3};  // last index, from 0
    size_t blockBytes = 48;
    std::string more = R"(Origin="1 2 3" Spacing="0.5 0.25 2")";
    std::string name = "velocity", before = {};  // another array in front of it
    std::string whole = {};                      // the type of whole numbers, instead of floats
    size_t wholeBytes = 4;

    std::string write(const std::vector<glm::dvec3>& values) const;

  private:
    void number(std::string& out, uint64_t bits, size_t bytes) const {
        for (size_t i = 0; i < bytes; ++i)
            out += char(bits >> (8 * (bigEndian ? bytes - 1 - i : i)) & 0xff);
    }
    static std::string base64(const std::string& bytes) {
        const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out;
        for (size_t i = 0; i < bytes.size(); i += 3) {
            uint32_t bits = 0;
            for (size_t k = 0; k < 3; ++k)
                bits = bits << 8 | (i + k < bytes.size() ? uint8_t(bytes[i + k]) : 0);
            for (size_t k = 0; k < 4; ++k)
                out += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
        }
        return out;
    }
    std::string payload(const std::string& data, bool inBase64) const;
};

inline std::string VtiText::payload(const std::string& data, bool inBase64) const {
    const size_t size = longHeader ? 8 : 4;
    std::string header, body = data;
    if (!zlib) {
        number(header, data.size(), size);
        return inBase64 ? base64(header + data) : header + data;
    }
    body.clear();
    const size_t blocks = (data.size() + blockBytes - 1) / blockBytes;
    number(header, blocks, size);
    number(header, blockBytes, size);
    number(header, data.size() % blockBytes, size);
    for (size_t i = 0; i < data.size(); i += blockBytes) {
        const std::string block = data.substr(i, blockBytes);
        uLongf bytes = compressBound(block.size());
        std::string packed(bytes, '\0');
        ::compress(reinterpret_cast<Bytef*>(packed.data()), &bytes,
                   reinterpret_cast<const Bytef*>(block.data()), block.size());
        body += packed.substr(0, bytes);
        number(header, bytes, size);
    }
    return inBase64 ? base64(header) + base64(body) : header + body;
}

inline std::string VtiText::write(const std::vector<glm::dvec3>& values) const {
    std::string data, text;
    for (const glm::dvec3& v : values)
        for (int k = 0; k < 3; ++k) {
            text += concat(v[k], k == 2 ? "\n" : " ");
            const float narrow = float(v[k]);
            uint64_t bits = 0;
            uint32_t narrowBits = 0;
            std::memcpy(&bits, &v[k], 8);
            std::memcpy(&narrowBits, &narrow, 4);
            if (whole.empty())
                number(data, wide ? bits : narrowBits, wide ? 8 : 4);
            else
                number(data, uint64_t(int64_t(v[k])), wholeBytes);
        }
    const bool appended = format == Format::appendedRaw || format == Format::appendedBase64;
    const std::string bounds = concat("0 ", extent.x, " 0 ", extent.y, " 0 ", extent.z);
    std::string array = concat("<DataArray type=\"",
                               !whole.empty() ? whole
                               : wide         ? "Float64"
                                              : "Float32",
                               "\" Name=\"", name, "\" NumberOfComponents=\"3\" format=\"",
                               appended                   ? "appended\" offset=\"0"
                               : format == Format::binary ? "binary"
                                                          : "ascii",
                               "\"");
    if (appended)
        array += "/>";
    else
        array += ">\n" + (format == Format::binary ? payload(data, true) : text) + "\n</DataArray>";
    const std::string kind = ofCells ? "CellData" : "PointData";
    return concat(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"",
        bigEndian ? "BigEndian" : "LittleEndian", "\" header_type=\"", longHeader ? "UInt64" : "UInt32", "\"",
        zlib ? " compressor=\"vtkZLibDataCompressor\"" : "", ">\n<ImageData WholeExtent=\"", bounds, "\" ",
        more, ">\n<Piece Extent=\"", bounds, "\">\n<", kind, ">\n", before, array, "\n</", kind,
        ">\n</Piece>\n</ImageData>\n",
        appended ? concat("<AppendedData encoding=\"", format == Format::appendedRaw ? "raw" : "base64",
                          "\">\n _", payload(data, format == Format::appendedBase64), "\n</AppendedData>\n")
                 : "",
        "</VTKFile>\n");
}

}  // namespace shoal::test
