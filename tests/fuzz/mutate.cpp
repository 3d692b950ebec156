#include "fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace shoal::test {

namespace {

bool isNumberPart(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
}

// Where a number begins and how long it is, at or after a random place.
std::pair<size_t, size_t> someNumber(const std::string& text, Random& random) {
    size_t begin = below(random, text.size());
    while (begin < text.size() && !(text[begin] >= '0' && text[begin] <= '9'))
        ++begin;
    size_t end = begin;
    while (end < text.size() && isNumberPart(text[end]))
        ++end;
    return {begin, end - begin};
}

std::string replaceNumber(std::string text, Random& random) {
    static constexpr std::array words = {"1e999",      "-1",       "1e308", "0",    "-0.0",  "1e-320",
                                         "NaN",        "Infinity", "null",  "true", "\"1\"", "[1]",
                                         "2147483648", "16777216", "{}",    "0.5"};
    const auto [begin, length] = someNumber(text, random);
    return text.replace(begin, length, words[below(random, words.size())]);
}

std::string nest(std::string text, Random& random) {
    const auto [begin, length] = someNumber(text, random);
    const size_t depth = below(random, 2) == 0 ? 70 : 20000;
    const bool closed = below(random, 2) == 0;
    return text.replace(begin, length, std::string(depth, '[') + (closed ? std::string(depth, ']') : ""));
}

// Exchanges two pieces between the separators of JSON and of fields.
std::string swapTokens(const std::string& text, Random& random) {
    std::vector<std::string> pieces = {""};
    for (const char c : text) {
        const bool separator = std::string_view(",:{}[] \n").find(c) != std::string_view::npos;
        if (separator) pieces.push_back(std::string(1, c));
        if (separator) pieces.push_back("");
        if (!separator) pieces.back() += c;
    }
    std::swap(pieces[below(random, pieces.size())], pieces[below(random, pieces.size())]);
    std::string out;
    for (const std::string& piece : pieces)
        out += piece;
    return out;
}

}  // namespace

size_t below(Random& random, size_t count) {
    return random.next() % std::max<size_t>(count, 1);
}

static std::string mutateOnce(std::string text, Random& random) {
    if (text.empty()) return text;
    switch (below(random, 8)) {
    case 0: {  // flips bits
        char& c = text[below(random, text.size())];
        c = static_cast<char>(c ^ (1 << below(random, 8)));
        return text;
    }
    case 1:
        return text.substr(0, below(random, text.size()));
    case 2:
        return text.erase(below(random, text.size()), 1 + below(random, 40));
    case 3:
        return swapTokens(text, random);
    case 4:
        return nest(std::move(text), random);
    case 5: {  // repeats a piece
        const std::string piece = text.substr(below(random, text.size()), 1 + below(random, 60));
        return text.insert(below(random, text.size()), piece);
    }
    default:
        return replaceNumber(std::move(text), random);
    }
}

std::string mutateText(const std::string& text, Random& random) {
    std::string out = mutateOnce(text, random);
    while (below(random, 3) == 0)
        out = mutateOnce(std::move(out), random);
    return out;
}

// Numbers of two, four and eight bytes at which counts and offsets go wrong.
static void replaceBytes(std::string& bytes, Random& random) {
    static constexpr std::array<uint64_t, 9> numbers = {0,
                                                        1,
                                                        0x7fffffff,
                                                        0x80000000,
                                                        0xffffffff,
                                                        0x7fffffffffffffff,
                                                        ~uint64_t{0},
                                                        0x7f800000,
                                                        0x7ff0000000000000};
    const size_t length = std::min<size_t>(size_t{1} << below(random, 4), bytes.size());
    const size_t at = below(random, bytes.size() - length + 1);
    std::memcpy(bytes.data() + at, &numbers[below(random, numbers.size())], length);
}

std::string mutateBytes(std::string bytes, Random& random) {
    do {
        if (bytes.empty()) return bytes;
        switch (below(random, 5)) {
        case 0:
            bytes.resize(below(random, bytes.size()));
            break;
        case 1:
            bytes.erase(below(random, bytes.size()), 1 + below(random, 16));
            break;
        case 2:
            bytes.insert(below(random, bytes.size()),
                         bytes.substr(below(random, bytes.size()), 1 + below(random, 64)));
            break;
        case 3:
            replaceBytes(bytes, random);
            break;
        default:
            bytes[below(random, bytes.size())] ^= char(1 << below(random, 8));
        }
    } while (below(random, 3) == 0);
    return bytes;
}

}  // namespace shoal::test
