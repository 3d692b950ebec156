// Damaged files: a reader succeeds or throws an Error; it never crashes, hangs or throws anything else.
// Worth most when built with the sanitizers.
#include <array>
#include <functional>
#include <vector>

#include "core/random.h"
#include "molecule/molecule_file.h"
#include "scene/read_fga.h"
#include "scene/scene_file.h"
#include "support/catch.h"
#include "support/small_scene.h"

using namespace shoal;
using namespace shoal::test;

namespace {

size_t below(Random& random, size_t count) {
    return random.next() % std::max<size_t>(count, 1);
}

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

std::string mutate(std::string text, Random& random) {
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

// How many of the mutants were refused. Any other exception fails the test.
int refused(const std::string& text, int count, const std::function<void(const std::string&)>& parse) {
    int refusals = 0;
    for (int i = 0; i < count; ++i) {
        Random random(static_cast<uint64_t>(i), 77);
        std::string mutant = mutate(text, random);
        if (below(random, 3) == 0) mutant = mutate(mutant.empty() ? text : mutant, random);
        try {
            parse(mutant);
        } catch (const Error& error) {
            ++refusals;
            if (error.message().empty() || error.location().file.empty()) FAIL_CHECK(error.what());
        } catch (const std::exception& other) {
            FAIL_CHECK("mutant " << i << " threw something else: " << other.what() << "\n" << mutant);
        }
    }
    return refusals;
}

}  // namespace

TEST_CASE("damaged molecule files are refused or read", "[mutations]") {
    CHECK(refused(smallMolecule, 600, [](const std::string& text) { parseMolecule(text, "m.json"); }) > 300);
}

TEST_CASE("damaged vector fields are refused or read", "[mutations]") {
    CHECK(refused(smallField, 600, [](const std::string& text) { parseFga(text, "f.fga"); }) > 300);
}

TEST_CASE("damaged scenes are refused or read, and placed", "[mutations]") {
    const Scratch scratch;
    writeSmallScene(scratch);
    const std::string file = scratch.path("s.json");
    CHECK(refused(smallScene, 600, [&](const std::string& text) {
              const Scene scene = parseScene(text, file);
              for (size_t g = 0; g < scene.groups.size(); ++g)
                  if (scene.groups[g].count <= 1000) place(scene, g);
          }) > 300);
}
