// Text to a tree of JsonValues, through RapidJSON's event reader.
//
// RapidJSON's events carry no dependable position (the stream is advanced before or after an event, by kind),
// so tokens are followed here: one starts at the first byte behind the previous one that is neither white
// space, comma nor colon, and its end is plain since the reader has accepted it.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <unordered_set>

#include <rapidjson/reader.h>

#include "core/file.h"
#include "core/json.h"

namespace shoal {

namespace {

constexpr size_t maxDepth = 64;
constexpr size_t maxFileBytes = size_t{1} << 28;

struct Position {
    int line = 1, column = 1;
    size_t offset = 0;
};

// Turns growing offsets into lines and columns in one sweep.
class LineCounter {
  public:
    explicit LineCounter(std::string_view text) : text_(text) {}

    Position position(size_t offset) {
        for (; offset_ < offset && offset_ < text_.size(); ++offset_) {
            if (text_[offset_] != '\n') continue;
            ++line_;
            lineStart_ = offset_ + 1;
        }
        return {line_, static_cast<int>(offset_ - lineStart_) + 1, offset_};
    }

  private:
    std::string_view text_;
    size_t offset_ = 0, lineStart_ = 0;
    int line_ = 1;
};

class TreeBuilder : public rapidjson::BaseReaderHandler<rapidjson::UTF8<>, TreeBuilder> {
  public:
    // `skipped` bytes of the file come before the text.
    TreeBuilder(std::string_view text, const std::string& file, size_t skipped)
        : text_(text), file_(file), skipped_(skipped), lines_(text) {}

    JsonValue takeRoot() { return std::move(root_); }

    bool Null() { return scalar(JsonValue{}); }
    bool Bool(bool value) { return scalar(JsonValue::makeBoolean(value)); }
    bool String(const char* characters, rapidjson::SizeType length, bool) {
        return scalar(JsonValue::makeString(std::string(characters, length)));
    }
    bool RawNumber(const char* characters, rapidjson::SizeType length, bool) {
        JsonValue value = JsonValue::makeNumber(0);
        value.text.assign(characters, length);
        const auto result = std::from_chars(characters, characters + length, value.number);
        const Position start = nextToken();
        if (result.ec != std::errc{} || result.ptr != characters + length || !std::isfinite(value.number))
            fail(start, concat("expected a number that fits a double, found ", value.text.substr(0, 40)));
        return scalar(std::move(value));
    }
    bool Key(const char* characters, rapidjson::SizeType length, bool) {
        Open& object = open_.back();
        const Position start = nextToken();
        skipToken();
        object.key.assign(characters, length);
        object.keyAt = start;
        if (!object.seen.insert(object.key).second) fail(start, "key \"" + object.key + "\" appears twice");
        return true;
    }
    bool StartObject() { return enter(JsonValue::makeObject()); }
    bool StartArray() { return enter(JsonValue::makeArray()); }
    bool EndObject(rapidjson::SizeType) { return leave(); }
    bool EndArray(rapidjson::SizeType) { return leave(); }

  private:
    struct Open {
        JsonValue value;
        Position start;
        std::string key;  // of the member being read
        Position keyAt;
        std::unordered_set<std::string> seen;
    };

    [[noreturn]] void fail(Position position, const std::string& message) const {
        throw Error({file_, position.line, position.column, path()}, message);
    }
    std::string path() const {
        std::string out = "$";
        for (const Open& open : open_) {
            if (open.value.kind == JsonValue::Kind::array)
                out += concat("[", open.value.items.size(), "]");
            else
                out += "." + open.key;
        }
        return out;
    }
    Position nextToken() {
        while (last_ < text_.size() &&
               std::string_view(" \t\r\n,:").find(text_[last_]) != std::string_view::npos)
            ++last_;
        return lines_.position(last_);
    }
    // Over a string, number or word.
    void skipToken() {
        if (text_[last_] == '"') {
            for (++last_; text_[last_] != '"'; ++last_)
                if (text_[last_] == '\\') ++last_;
            ++last_;
        } else {
            last_ = std::min(text_.find_first_of(" \t\r\n,:]}", last_), text_.size());
        }
    }
    bool scalar(JsonValue value) {
        const Position start = nextToken();
        skipToken();
        place(std::move(value), start);
        return true;
    }
    bool enter(JsonValue value) {
        const Position start = nextToken();
        if (open_.size() >= maxDepth) fail(start, concat("is nested deeper than ", maxDepth, " levels"));
        ++last_;
        open_.push_back({std::move(value), start, {}, {}, {}});
        return true;
    }
    bool leave() {
        nextToken();
        ++last_;
        JsonValue value = std::move(open_.back().value);
        const Position start = open_.back().start;
        open_.pop_back();
        place(std::move(value), start);
        return true;
    }
    void place(JsonValue value, Position start) {
        value.line = start.line;
        value.column = start.column;
        value.begin = skipped_ + start.offset;
        value.end = skipped_ + last_;
        if (open_.empty()) {
            root_ = std::move(value);
            return;
        }
        Open& parent = open_.back();
        if (parent.value.kind == JsonValue::Kind::array) {
            parent.value.items.push_back(std::move(value));
            return;
        }
        value.keyLine = parent.keyAt.line;
        value.keyColumn = parent.keyAt.column;
        value.keyBegin = skipped_ + parent.keyAt.offset;
        parent.value.members.push_back({parent.key, std::move(value)});
    }

    std::string_view text_;
    const std::string& file_;
    size_t skipped_;
    LineCounter lines_;
    size_t last_ = 0;  // just behind the previous token
    std::vector<Open> open_;
    JsonValue root_;
};

std::string expectation(rapidjson::ParseErrorCode code) {
    static constexpr std::pair<rapidjson::ParseErrorCode, const char*> known[] = {
        {rapidjson::kParseErrorDocumentEmpty, "expected a JSON object"},
        {rapidjson::kParseErrorDocumentRootNotSingular, "expected the end of the file"},
        {rapidjson::kParseErrorValueInvalid, "expected a value"},
        {rapidjson::kParseErrorObjectMissName, "expected a key in double quotes"},
        {rapidjson::kParseErrorObjectMissColon, "expected ':' after the key"},
        {rapidjson::kParseErrorObjectMissCommaOrCurlyBracket, "expected ',' or '}'"},
        {rapidjson::kParseErrorArrayMissCommaOrSquareBracket, "expected ',' or ']'"},
        {rapidjson::kParseErrorStringUnicodeEscapeInvalidHex, "expected four hexadecimal digits after \\u"},
        {rapidjson::kParseErrorStringUnicodeSurrogateInvalid, "expected a valid surrogate pair after \\u"},
        {rapidjson::kParseErrorStringEscapeInvalid, "expected one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u"},
        {rapidjson::kParseErrorStringMissQuotationMark, "expected a closing quotation mark in this line"},
        {rapidjson::kParseErrorStringInvalidEncoding, "expected UTF-8 text"},
        {rapidjson::kParseErrorNumberTooBig, "expected a number that fits a double"},
        {rapidjson::kParseErrorNumberMissFraction, "expected digits after the decimal point"},
        {rapidjson::kParseErrorNumberMissExponent, "expected digits in the exponent"},
    };
    for (const auto& [error, words] : known)
        if (error == code) return words;
    return "expected JSON";
}

std::string found(std::string_view text, size_t offset, rapidjson::ParseErrorCode code) {
    if (code == rapidjson::kParseErrorNumberTooBig)
        return std::string(text.substr(
            offset, std::min<size_t>(40, text.find_first_not_of("+-.0123456789eE", offset) - offset)));
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) return "an empty file";
    if (offset >= text.size()) return "the end of the file";
    for (const char* word : {"NaN", "nan", "Infinity", "Inf", "inf"})
        if (text.substr(offset).starts_with(word)) return concat(word, " (JSON has finite numbers only)");
    const unsigned char byte = static_cast<unsigned char>(text[offset]);
    if (byte == '\n' || byte == '\r') return "the end of the line";
    if (text.substr(offset).starts_with("//") || text.substr(offset).starts_with("/*"))
        return "a comment (use a key \"comment\")";
    if (byte >= 0x20 && byte < 0x7f) return concat("'", text[offset], "'");
    return concat("byte ", static_cast<int>(byte));
}

}  // namespace

JsonValue parseJson(const std::string& source, const std::string& file) {
    std::string_view text = source;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    // The reader takes a zero byte for the end, so what stands behind one would be ignored.
    if (const size_t zero = text.find('\0'); zero != std::string_view::npos)
        throw Error(locate(text, zero, file), "expected JSON, found a zero byte");
    rapidjson::StringStream stream(text.data());
    TreeBuilder builder(text, file, source.size() - text.size());
    rapidjson::Reader reader;
    constexpr unsigned flags = rapidjson::kParseIterativeFlag | rapidjson::kParseNumbersAsStringsFlag |
                               rapidjson::kParseValidateEncodingFlag;
    const rapidjson::ParseResult result = reader.Parse<flags>(stream, builder);
    if (result.IsError()) {
        size_t offset = std::min(result.Offset(), text.size());
        if (result.Code() == rapidjson::kParseErrorValueInvalid && offset > 0 && offset < text.size() &&
            std::isalpha(static_cast<unsigned char>(text[offset - 1])) != 0)
            while (offset > 0 && std::isalpha(static_cast<unsigned char>(text[offset - 1])) != 0)
                --offset;  // back to the start of a word such as "nan" or "tru"
        throw Error(locate(text, offset, file), expectation(result.Code()), ", found ",
                    found(text, offset, result.Code()));
    }
    return builder.takeRoot();
}

JsonValue readJson(const std::string& file) {
    return parseJson(readFile(file, maxFileBytes), file);
}

}  // namespace shoal
