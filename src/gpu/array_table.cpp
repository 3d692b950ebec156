#include "gpu/array_table.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "core/contract.h"
#include "core/file.h"

namespace shoal::gpu {

namespace {

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> out(1);
    for (const char c : text) {
        if (c == separator)
            out.emplace_back();
        else if (separator == ' ' || c != ' ' || !out.back().empty())
            out.back() += c;
    }
    for (std::string& part : out)
        part.resize(part.find_last_not_of(' ') + 1);
    if (separator == ' ') std::erase(out, "");
    return out;
}

// Takes a number from the front of a text; without one `usual`.
int takeNumber(std::string_view& text, int usual) {
    int out = usual;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), out);
    text.remove_prefix(size_t(read.ptr - text.data()));
    return out;
}

bool takeWord(std::string_view& text, std::string_view word) {
    if (text.substr(0, word.size()) != word) return false;
    text.remove_prefix(word.size());
    return true;
}

const char* typeOf(const ArrayRow& row) {
    constexpr const char* types[] = {"vec4", "uvec4", "uvec2", "uint"};
    return types[size_t(row.texel)];
}

const char* partsOf(const ArrayRow& row) {
    constexpr const char* parts[] = {"", "", ".xy", ".x"};
    return parts[size_t(row.texel)];
}

std::string capital(std::string name) {
    name[0] = char(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

// Arguments that name a value, and where it lies in a buffer.
std::string argumentsOf(const ArrayRow& row, const char* type) {
    const std::string i = concat(type, "i");
    if (row.ofList) return concat(i, ", ", type, "e");
    return row.count > 1 ? concat(i, ", ", type, "k") : i;
}

std::string placeOf(const ArrayRow& row) {
    if (row.ofList) return "(e) * listStride + (i)";
    return row.count > 1 ? concat(row.count, " * (i) + (k)") : "i";
}

}  // namespace

ArrayTable::ArrayTable(const std::string& file, Form form, std::set<std::string> holds)
    : file_(file), form_(form), holds_(std::move(holds)) {
    holds_.insert(form == Form::buffers ? "buffers" : "textures");
    const std::string text = readFile(file);
    int number = 0;
    for (const std::string& line : split(text, '\n')) {
        ++number;
        const Location here{file, number, 0, {}};
        if (line.empty() || line[0] == '#') {
            constexpr std::string_view include = "#include \"";
            if (line.compare(0, include.size(), include) == 0)
                includes_.push_back(line.substr(include.size(), line.size() - include.size() - 1));
            continue;
        }
        readRow(split(line, '|'), here);
    }
}

// name | form | value | of | lives | starts | when | meaning
void ArrayTable::readRow(const std::vector<std::string>& cells, const Location& where) {
    const auto need = [&](bool holds, const char* what) {
        if (!holds) throw Error(where, concat("an array's row needs ", what));
    };
    need(cells.size() == 8,
         "eight columns: name | form | value | of | lives | starts | when it is needed | meaning");
    const std::string& form = cells[1];
    need(form == "both" || form == "buffers" || form == "textures", "a form: both, buffers or textures");
    ArrayRow row;
    row.name = cells[0];
    std::string_view value = cells[2];
    row.packed = takeNumber(value, 1);
    constexpr std::string_view texels[] = {"float4", "uint4", "uint2", "uint1"};
    const auto* texel = std::find(std::begin(texels), std::end(texels), value);
    row.isRecord = value == "record";
    need(row.isRecord || texel != std::end(texels), "a value: float4, uint4, uint2, uint1 or record");
    row.texel = row.isRecord ? Texel::uint1 : Texel(texel - std::begin(texels));
    std::string_view subject = cells[3];
    row.count = takeNumber(subject, 1);
    if (takeWord(subject, "*") && takeWord(subject, "list*")) row.ofList = true;
    row.ofList = row.ofList || takeWord(subject, "list*");
    row.index = subject.substr(0, subject.find('+'));
    subject.remove_prefix(row.index.size());
    if (takeWord(subject, "+")) row.more = size_t(takeNumber(subject, 0));
    need(cells[4] == "plan" || cells[4] == "stage" || cells[4] == "step" || cells[4] == "steps",
         "a life: plan, stage, step or steps");
    constexpr std::string_view starts[] = {"-", "0", "far"};
    const auto* start = std::find(std::begin(starts), std::end(starts), cells[5]);
    need(start != std::end(starts), "a start: -, 0 or far");
    row.start = ArrayRow::Start(start - std::begin(starts));
    row.when = split(cells[6], ' ');
    std::erase(row.when, "always");
    row.isNeeded = meets(row.when);
    const bool isHere = form == "both" || (form == "buffers") == (form_ == Form::buffers);
    if (!(isHere ? rows_ : elsewhere_).emplace(row.name, row).second)
        throw Error(where, concat("there are two arrays \"", row.name, "\""));
}

const ArrayRow* ArrayTable::find(std::string_view name) const {
    const auto found = rows_.find(name);
    return found == rows_.end() ? nullptr : &found->second;
}

const ArrayRow* ArrayTable::findAbsent(std::string_view name) const {
    if (const ArrayRow* here = find(name)) return here->isNeeded ? nullptr : here;
    const auto found = elsewhere_.find(name);
    return found == elsewhere_.end() ? nullptr : &found->second;
}

bool ArrayTable::meets(const std::vector<std::string>& when) const {
    return std::all_of(when.begin(), when.end(), [&](const std::string& word) {
        return word[0] == '!' ? !holds_.contains(word.substr(1)) : holds_.contains(word);
    });
}

const ArrayRow& ArrayTable::row(std::string_view name, const Location& asker) const {
    if (const ArrayRow* found = find(name)) return *found;
    std::vector<std::string> names;
    for (const auto& [known, row] : rows_)
        names.push_back(known);
    const std::string near = nearest(std::string(name), names);
    throw Error(asker, concat("there is no array \"", name, "\" in ", file_,
                              near.empty() ? "" : concat(" (did you mean \"", near, "\"?)")));
}

// Declares that values put into an array go nowhere.
std::string ArrayDeclarations::nowhere(const ArrayRow& row) {
    if (std::find(written_.begin(), written_.end(), row.name) != written_.end()) return "";
    if (!nowhere_.insert(row.name).second) return "";
    const std::string name = capital(row.name);
    return concat("#define put", name, "(", argumentsOf(row, ""), ", value)\n#define putAll", name,
                  "(i, values)\n");
}

// Declares an array that is not there.
std::string ArrayDeclarations::absent(const ArrayRow& row, const std::string& verb) {
    std::string out = verb == "reads" ? "" : nowhere(row);
    if (verb != "writes" && read_.insert(row.name).second)
        out += concat("#define ", row.name, "At(", argumentsOf(row, ""), ") ", typeOf(row), "(0)\n");
    return out;
}

std::string ArrayDeclarations::withStride(const ArrayRow& row) {
    if (!row.ofList || hasStride_ || table_->form() == ArrayTable::Form::textures) return "";
    hasStride_ = true;
    return "uniform int listStride;\n";
}

std::string ArrayDeclarations::reading(const ArrayRow& row) {
    if (!read_.insert(row.name).second) return "";
    const bool textures = table_->form() == ArrayTable::Form::textures;
    const bool layered = row.count > 1 || row.ofList;
    const char* whole = row.texel == Texel::float4 ? "" : "u";
    const std::string head = concat(typeOf(row), " ", row.name, "At(", argumentsOf(row, "int "), ")\n{\n");
    std::string sampler = "samplerBuffer", fetched;
    if (textures) sampler = layered ? "sampler2DArray" : "sampler2D";
    if (!textures) {
        fetched = concat("    return texelFetch(", row.name, ", ", placeOf(row), ")", partsOf(row));
    } else if (row.packed == 4) {
        fetched = concat("    return texelFetch(", row.name, ", ivec3(texelOf(i), e >> 2), 0)[e & 3]");
    } else if (row.packed == 2) {
        fetched = concat("    uvec4 two = texelFetch(", row.name,
                         ", texelOf(i >> 1), 0);\n    return (i & 1) == 0 ? two.xy : two.zw");
    } else {
        const std::string texel =
            layered ? concat("ivec3(texelOf(i), ", row.ofList ? "e" : "k", ")") : "texelOf(i)";
        fetched = concat("    return texelFetch(", row.name, ", ", texel, ", 0)", partsOf(row));
    }
    return concat(withStride(row), "uniform ", whole, sampler, " ", row.name, ";\n", head, fetched, ";\n}\n");
}

std::string ArrayDeclarations::block(const ArrayRow& row, bool alsoReads) {
    if (std::find(written_.begin(), written_.end(), row.name) != written_.end()) return "";
    written_.push_back(row.name);
    const std::string name = capital(row.name);
    std::string out =
        concat(withStride(row), "layout(std430) ", alsoReads ? "" : "writeonly ", "buffer ", name, " { ",
               typeOf(row), " ", row.name, "Buffer[]; };\n#define put", name, "(", argumentsOf(row, ""),
               ", value) ", row.name, "Buffer[", placeOf(row), "] = (value)\n");
    if (alsoReads) {
        updated_.push_back(row.name);
        read_.insert(row.name);
        out += concat(typeOf(row), " ", row.name, "At(", argumentsOf(row, "int "), ")\n{\n    return ",
                      row.name, "Buffer[", placeOf(row), "];\n}\n");
    }
    if (row.count > 1)
        out += concat("void putAll", name, "(int i, ", typeOf(row), " values[", row.count,
                      "])\n{\n    for (int k = 0; k < ", row.count, "; ++k) put", name,
                      "(i, k, values[k]);\n}\n");
    return out;
}

std::string ArrayDeclarations::outputs(const std::vector<const ArrayRow*>& rows) {
    std::string out, copies;
    const auto lists = std::count_if(rows.begin(), rows.end(),
                                     [](const ArrayRow* row) { return row->ofList && row->packed == 1; });
    const int together = lists > 0 ? drawBuffers / int(lists) : 0;
    if (lists > 0) out += concat("#define ENTRIES_A_DRAW ", together, "\nuniform int firstEntry;\n");
    for (const ArrayRow* row : rows) {
        written_.push_back(row->name);
        if (nowhere_.erase(row->name) != 0)
            out += concat("#undef put", capital(row->name), "\n#undef putAll", capital(row->name), "\n");
        const std::string name = capital(row->name), output = concat("new", name),
                          put = concat("#define put", name, "(", argumentsOf(*row, ""));
        const std::string head = concat("layout(location = ", location_, ") out ");
        if (row->ofList && row->packed > 1) {
            EXPECTS(row == rows.back() && "how many outputs it takes is known to the shader alone");
            out += concat(head, "uvec4 ", output, "[LIST / 4];\n");
        } else if (row->ofList) {
            out += concat(head, typeOf(*row), " ", output, "[ENTRIES_A_DRAW];\n", typeOf(*row), " ",
                          row->name, "Values[ENTRIES_A_DRAW];\n", put, ", value) ", row->name,
                          "Values[(e) - firstEntry] = (value)\n");
            copies += concat("    ", output, " = ", row->name, "Values;\n");
            location_ += together;
        } else if (row->packed > 1) {
            out += concat(head, "uvec4 ", output, ";\n");
            ++location_;
        } else if (row->count > 1) {
            out += concat(head, typeOf(*row), " ", output, "[", row->count, "];\n", put, ", value) ", output,
                          "[k] = (value)\n#define putAll", name, "(i, values) ", output, " = (values)\n");
            location_ += row->count;
        } else {
            out += concat(head, typeOf(*row), " ", output, ";\n", put, ", value) ", output, " = (value)\n");
            ++location_;
        }
    }
    if (lists > 0) out += concat("void putEntries()\n{\n", copies, "}\n");
    return out;
}

std::string ArrayDeclarations::declare(const std::string& verb, const std::vector<std::string>& words,
                                       const Location& where) {
    if (verb != "reads" && verb != "writes" && verb != "updates")
        throw Error(where, "expected #pragma reads, writes or updates, and names of arrays");
    const bool textures = table_->form() == ArrayTable::Form::textures;
    const auto last = std::find(words.begin(), words.end(), "when");
    const bool isMet = last == words.end() || table_->meets({last + 1, words.end()});
    std::vector<const ArrayRow*> rows;
    std::string out;
    for (auto name = words.begin(); name != last; ++name) {
        const ArrayRow* missing = table_->findAbsent(*name);
        if (!missing && !isMet) {
            missing = &table_->row(*name, where);
            if (verb == "updates") zeros_.insert(*name);
        } else if (!missing && verb == "reads" && zeros_.contains(*name)) {
            throw Error(where,
                        concat("\"", *name, "\" is read, but was updated for some scenes or forms only, ",
                               "and is zeros in others"));
        }
        if (missing)
            out += absent(*missing, verb);
        else
            rows.push_back(&table_->row(*name, where));
    }
    if (verb == "writes" && textures) return out + outputs(rows);
    for (const ArrayRow* row : rows) {
        if (verb == "updates" && !textures && read_.contains(row->name))
            throw Error(where, concat("\"", row->name, "\" is updated after it was read"));
        out += verb == "reads" || textures ? reading(*row) : block(*row, verb == "updates");
        if (verb == "updates" && textures) out += nowhere(*row);
    }
    return out;
}

}  // namespace shoal::gpu
