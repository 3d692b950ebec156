#include "geometry/obj_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "geometry/model_reader.h"

namespace shoal {

namespace {

// Takes the first word off `text`, with the blanks behind it, and returns it.
std::string_view firstWord(std::string_view& text) {
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text = trimmed(text.substr(word.size()));
    return word;
}

// Without what stands behind a #.
std::string_view uncommented(std::string_view text) {
    return trimmed(text.substr(0, text.find('#')));
}

// Lines that change nothing that is drawn.
const std::set<std::string, std::less<>> harmless = {"bevel",      "c_interp",  "d_interp", "lod",  "mg",
                                                     "shadow_obj", "trace_obj", "ctech",    "stech"};

}  // namespace

bool readNumbers(std::string_view text, std::vector<double>& out) {
    for (text = trimmed(text); !text.empty();) {
        std::string_view word = firstWord(text);
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (end != word.data() + word.size() || code == std::errc::invalid_argument) return false;
        out.push_back(value);
    }
    return true;
}

ObjText::ObjText(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // the mark of UTF-8
}

ObjText::int_type ObjText::underflow() {
    if (gptr() < egptr()) return traits_type::to_int_type(*gptr());
    if (announced_) {
        if (lost_++ == 0) firstLost_ = line_;
        announced_ = false;
    }
    for (;;) {
        if (!nextLine()) return traits_type::eof();
        std::string_view rest = trimmed(now_);
        const std::string_view keyword = firstWord(rest);
        if (keyword.empty() || keyword.starts_with('#') || !keep(keyword, rest)) continue;
        now_ = std::string(keyword) + " " + std::string(rest) + "\n";
        announced_ = true;
        setg(now_.data(), now_.data(), now_.data() + now_.size());
        return traits_type::to_int_type(now_.front());
    }
}

// A backslash at its end continues a line.
bool ObjText::nextLine() {
    if (at_ >= text_.size()) return false;
    now_.clear();
    line_ = nextLine_;
    for (bool more = true; more && at_ < text_.size(); ++nextLine_) {
        const size_t end = std::min(text_.find_first_of("\n\r", at_), text_.size());
        std::string_view piece(text_.data() + at_, end - at_);
        at_ = end + (text_.compare(end, 2, "\r\n") == 0 ? 2 : 1);
        more = piece.ends_with('\\');
        if (more) piece.remove_suffix(1);
        now_.append(piece).append(more ? " " : "");
    }
    std::replace(now_.begin(), now_.end(), '\0', ' ');  // which would end the line for the reader
    return true;
}

// Whether a line is handed over; `rest` loses what the reader would stumble on.
bool ObjText::keep(std::string_view keyword, std::string_view& rest) {
    if (keyword == "o" || keyword == "g" || keyword == "usemtl") return true;
    if (keyword == "mtllib") {
        libraries_.emplace_back(rest);
        return false;
    }
    if (keyword == "s") {
        std::vector<double> group;
        smoothing_ = readNumbers(rest, group) && !group.empty() ? int(std::clamp(group[0], 0.0, 1e9)) : 0;
        if (rest == "on") smoothing_ = 1;
        return false;
    }
    if (keyword == "v" || keyword == "vn" || keyword == "vt") {
        rest = uncommented(rest);
        checkNumbers(keyword, rest);
        return true;
    }
    if (keyword == "f") {
        rest = uncommented(rest);
        checkFace(rest);
        return true;
    }
    if (!harmless.contains(keyword) && others_.size() < 20) ++others_[std::string(keyword.substr(0, 20))];
    return false;
}

void ObjText::checkNumbers(std::string_view keyword, std::string_view rest) {
    numbers_.clear();
    const size_t least = keyword == "vt" ? 1 : 3;
    if (!readNumbers(rest, numbers_) || numbers_.size() < least)
        throw fail(
            concat("expected ", least == 3 ? "three numbers" : "a number", " behind \"", keyword, "\""));
    if (!std::all_of(numbers_.begin(), numbers_.begin() + std::ptrdiff_t(least),
                     [](double number) { return std::isfinite(number); }) &&
        keyword == "v")
        throw fail("a vertex is not finite, expected three finite numbers");
    if (keyword != "v") return;
    color_.reset();
    if (numbers_.size() >= 6) color_ = glm::dvec3(numbers_[3], numbers_[4], numbers_[5]);
}

// "1", "1/2", "1//3" or "1/2/3" for each corner.
void ObjText::checkFace(std::string_view rest) const {
    while (!rest.empty()) {
        const std::string_view corner = firstWord(rest);
        const char* next = corner.data();
        const char* end = next + corner.size();
        for (int slot = 0; next <= end && slot < 4; ++slot) {
            int index = 0;
            const auto [stop, code] = std::from_chars(next, end, index);
            const bool absent = slot > 0 && stop == next;  // as in "1//3"
            if (slot == 3 || (!absent && (code != std::errc() || index == 0)) || (stop < end && *stop != '/'))
                throw fail(concat("a face has the corner \"", corner,
                                  "\", expected numbers from 1 on, or below 0, as in 1/2/3"));
            next = stop + 1;
        }
    }
}

}  // namespace shoal
