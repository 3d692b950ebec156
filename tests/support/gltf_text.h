// glTF files written for the tests: arrays of numbers, and what is said of them.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"

namespace shoal::test {

inline std::string base64(const std::string& bytes) {
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        unsigned bits = 0;
        for (size_t k = i; k < i + 3; ++k)
            bits = bits << 8 | (k < bytes.size() ? uint8_t(bytes[k]) : 0);
        for (size_t k = 0; k < 4; ++k)
            out += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
    }
    return out;
}

class GltfText {
  public:
    // Returns the number of an accessor of these numbers; `more` are keys of it.
    template <typename T>
    int add(const std::vector<T>& numbers, const char* type, int componentType, size_t components,
            const std::string& more = "") {
        return addAccessor(addView(numbers), numbers.size() / components, type, componentType, more);
    }
    int floats(const std::vector<float>& numbers, const char* type, size_t components) {
        return add(numbers, type, 5126, components);
    }
    int points(const std::vector<float>& numbers) { return floats(numbers, "VEC3", 3); }
    int indices(const std::vector<uint16_t>& numbers) { return add(numbers, "SCALAR", 5123, 1); }

    template <typename T>
    int addView(const std::vector<T>& numbers) {
        bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
        views_.push_back(concat("{\"buffer\": 0, \"byteOffset\": ", bytes_.size(),
                                ", \"byteLength\": ", numbers.size() * sizeof(T)));
        bytes_.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
        return int(views_.size()) - 1;
    }
    int addAccessor(int view, size_t count, const char* type, int componentType,
                    const std::string& more = "") {
        accessors_.push_back(concat(view < 0 ? "{" : concat("{\"bufferView\": ", view, ", "),
                                    "\"componentType\": ", componentType, ", \"count\": ", count,
                                    ", \"type\": \"", type, "\"", more, "}"));
        return int(accessors_.size()) - 1;
    }
    // Adds keys to a view.
    void say(int view, const std::string& keys) { views_[size_t(view)] += ", " + keys; }

    // The file, with these keys at its root beside those of arrays. `uri`: of its buffer, whose bytes lie
    // within the file unless it is given.
    std::string text(const std::string& root) const {
        return head(root) + R"(, "buffers": [{"byteLength": )" + std::to_string(bytes_.size()) +
               R"(, "uri": "data:application/octet-stream;base64,)" + base64(bytes_) + "\"}]}";
    }
    // The same in the binary form. `buffers`: keys and further buffers behind the bytes'.
    std::string binary(const std::string& root, const std::string& buffers = "") const {
        std::string json = head(root) + R"(, "buffers": [{"byteLength": )" + std::to_string(bytes_.size()) +
                           "}" + buffers + "]}";
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string bytes = bytes_;
        bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
        return "glTF" + number(2) + number(28 + json.size() + bytes.size()) + number(json.size()) + "JSON" +
               json + number(bytes.size()) + std::string("BIN\0", 4) + bytes;
    }

  private:
    static std::string number(size_t value) {
        std::string out;
        for (int i = 0; i < 4; ++i)
            out += char(value >> (8 * i) & 255);
        return out;
    }
    std::string head(const std::string& root) const {
        std::string views;
        for (const std::string& view : views_)
            views += (views.empty() ? "" : ", ") + view + "}";
        return R"({"asset": {"version": "2.0"}, )" + root + R"(, "bufferViews": [)" + views +
               R"(], "accessors": [)" + joined(accessors_, ", ") + "]";
    }

    std::string bytes_;
    std::vector<std::string> views_, accessors_;
};

// The corners and triangles of a box of 1 x 2 x 3 m at the origin.
inline const std::vector<float> boxPoints = {0, 0, 0, 0, 0, 3, 0, 2, 0, 0, 2, 3,
                                             1, 0, 0, 1, 0, 3, 1, 2, 0, 1, 2, 3};
inline const std::vector<uint16_t> boxTriangles = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                                   2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};

}  // namespace shoal::test
