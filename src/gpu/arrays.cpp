#include "gpu/arrays.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/contract.h"

namespace shoal::gpu {

namespace {

size_t bytesOf(Texel texel) {
    static constexpr size_t words[] = {4, 4, 2, 1};
    return words[size_t(texel)] * sizeof(uint32_t);
}

Format formatOf(const ArrayRow& row) {
    if (row.packed > 1) return Format::rgba32ui;
    static constexpr Format formats[] = {Format::rgba32f, Format::rgba32ui, Format::rg32ui, Format::r32ui};
    return formats[size_t(row.texel)];
}

// The array that a storage block holds.
std::string arrayOf(std::string block) {
    block[0] = char(std::tolower(static_cast<unsigned char>(block[0])));
    return block;
}

// The bytes that an array of so many texels begins with; none where nobody reads what nobody wrote.
std::vector<std::byte> beginning(const ArrayRow& row, size_t bytes) {
    if (row.start == ArrayRow::Start::undefined) return {};
    std::vector<std::byte> out(bytes);
    if (row.start == ArrayRow::Start::zero) return out;
    const glm::vec4 far(0, 0, 0, 1e30f);
    for (size_t i = 0; i + sizeof far <= bytes; i += sizeof far)
        std::copy_n(reinterpret_cast<const std::byte*>(&far), sizeof far, out.begin() + ptrdiff_t(i));
    return out;
}

}  // namespace

Array::Array(Context& context, size_t texels, Texel texel, const char* label, const void* data)
    : buffer(context, Buffer::Use::storage, data, texels * bytesOf(texel), label),
      texture(context, buffer, texel, label) {}

Arrays::Arrays(Context& context, const ArrayTable& table, const ArraySizes& sizes, const std::string& label)
    : context_(&context), table_(&table), sizes_(sizes), label_(label), framebuffers_(context) {
    for (const auto& [name, row] : table.rows()) {
        Entry& entry = arrays_[name];
        entry.row = &row;
        if (row.index == "given" || !row.isNeeded) continue;
        size_t elements = row.more;
        if (row.index.empty()) {
            ++elements;
        } else {
            EXPECTS(sizes.counts.contains(row.index) && "how many there are is known");
            elements += sizes.counts.at(row.index);
        }
        if (table.form() == ArrayTable::Form::textures)
            makeTexture(entry, elements, nullptr);
        else
            makeBuffer(entry, elements * (row.ofList ? sizes.list : size_t(row.count)), nullptr);
    }
}

// What it begins with is written in small parts: a block as large as an array would change where the
// allocator of a CPU rasteriser puts the arrays after it, which then lie worse for its caches (a tenth of a
// step of contact).
void Arrays::makeBuffer(Entry& entry, size_t values, const void* data) {
    const ArrayRow& row = *entry.row;
    const std::string label = concat(label_, " ", row.name);
    const size_t bytes = values * bytesOf(row.texel);
    if (row.isRecord)
        entry.array.buffer = Buffer(*context_, Buffer::Use::storage, data, bytes, label.c_str());
    else
        entry.array = Array(*context_, values, row.texel, label.c_str(), data);
    if (data) return;
    constexpr size_t part = size_t(1) << 16;
    const std::vector<std::byte> first = beginning(row, std::min(bytes, part));
    for (size_t done = 0; !first.empty() && done < bytes; done += first.size())
        entry.array.buffer.update(Traffic::Kind::parameters, done, first.data(),
                                  std::min(first.size(), bytes - done));
}

void Arrays::makeTexture(Entry& entry, size_t elements, const void* data) {
    const ArrayRow& row = *entry.row;
    const int width = 1 << sizes_.rowBits;
    const size_t texels = row.packed == 2 ? (elements + 1) / 2 : elements;
    const int rows = int(std::max<size_t>(1, (texels + size_t(width) - 1) >> sizes_.rowBits));
    const size_t perList = row.ofList ? sizes_.list / size_t(row.packed) : size_t(row.count);
    const int layers = row.ofList || row.count > 1 ? int(perList) : 0;
    entry.texture =
        Texture(*context_, formatOf(row), width, rows, concat(label_, " ", row.name).c_str(), layers);
    const size_t layerBytes = size_t(width) * size_t(rows) * texelBytes(formatOf(row));
    std::vector<std::byte> first = beginning(row, layerBytes);
    if (data) {
        first.resize(layerBytes);
        std::copy_n(static_cast<const std::byte*>(data), elements * texelBytes(formatOf(row)), first.begin());
    }
    for (int layer = 0; !first.empty() && layer < std::max(layers, 1); ++layer)
        entry.texture.upload(Traffic::Kind::parameters, 0, 0, width, rows, first.data(), first.size(), layer);
}

void Arrays::give(const std::string& name, const void* data, size_t values) {
    Entry& entry = entryOf(name);
    if (table_->form() == ArrayTable::Form::textures)
        makeTexture(entry, values, data);
    else
        makeBuffer(entry, values, data);
}

void Arrays::write(const std::string& name, Traffic::Kind kind, const void* data, size_t values) {
    const Entry& entry = entryOf(name);
    const size_t each = bytesOf(entry.row->texel);
    EXPECTS(entry.row->count == 1 && !entry.row->ofList && entry.row->packed == 1);
    if (table_->form() == ArrayTable::Form::buffers) return buffer(name).update(kind, 0, data, values * each);
    const int width = 1 << sizes_.rowBits;
    const auto* bytes = static_cast<const std::byte*>(data);
    const auto rows = int(values >> sizes_.rowBits), rest = int(values) - rows * width;
    const size_t whole = size_t(rows) * size_t(width) * each;
    if (rows > 0) texture(name).upload(kind, 0, 0, width, rows, bytes, whole);
    if (rest > 0) texture(name).upload(kind, 0, rows, rest, 1, bytes + whole, size_t(rest) * each);
}

// Visits the layers of a texture: where an element's texel lies in each, and its place in the element.
template <typename Visit>
static void forLayers(const ArrayRow& row, size_t element, int rowBits, const Visit& visit) {
    const size_t each = bytesOf(row.texel), width = size_t(1) << rowBits;
    for (int k = 0; k < row.count; ++k)
        visit(glm::ivec2(element % width, element / width), size_t(k) * each, each, k);
}

void Arrays::writeElement(const std::string& name, Traffic::Kind kind, size_t element, const void* data) {
    const ArrayRow& row = *entryOf(name).row;
    const size_t bytes = bytesOf(row.texel) * size_t(row.count);
    if (table_->form() == ArrayTable::Form::buffers)
        return buffer(name).update(kind, element * bytes, data, bytes);
    forLayers(row, element, sizes_.rowBits, [&](glm::ivec2 texel, size_t offset, size_t each, int layer) {
        texture(name).upload(kind, texel.x, texel.y, 1, 1, static_cast<const std::byte*>(data) + offset, each,
                             layer);
    });
}

void Arrays::readElement(const std::string& name, Traffic::Kind kind, size_t element, void* data) const {
    const ArrayRow& row = *entryOf(name).row;
    const size_t bytes = bytesOf(row.texel) * size_t(row.count);
    if (table_->form() == ArrayTable::Form::buffers)
        return buffer(name).download(kind, element * bytes, data, bytes);
    forLayers(row, element, sizes_.rowBits, [&](glm::ivec2 texel, size_t offset, size_t each, int layer) {
        texture(name).download(kind, texel.x, texel.y, 1, 1, static_cast<std::byte*>(data) + offset, each,
                               layer);
    });
}

const Arrays::Entry* Arrays::find(std::string_view name) const {
    const auto alias = aliases_.find(name);
    const auto found = arrays_.find(alias == aliases_.end() ? name : std::string_view(alias->second));
    return found == arrays_.end() ? nullptr : &found->second;
}

const Arrays::Entry& Arrays::entryOf(const std::string& name) const {
    const Entry* found = find(name);
    EXPECTS(found && "the table has an array of that name");
    return *found;
}

bool Arrays::has(const std::string& name) const {
    const Entry& entry = entryOf(name);
    return entry.array.buffer || entry.texture || entry.lent;
}

void Arrays::swap(const std::string& a, const std::string& b) {
    Entry &first = entryOf(a), &second = entryOf(b);
    std::swap(first.array, second.array);
    std::swap(first.texture, second.texture);
}

void Arrays::rotate(const std::vector<std::string>& names) {
    for (size_t i = names.size() - 1; i > 0; --i)
        swap(names[i], names[i - 1]);
}

const Arrays::Uses& Arrays::usesOf(const Program& program) const {
    const auto known = uses_.find(program.id());
    if (known != uses_.end()) return known->second;
    Uses& out = uses_[program.id()];
    for (const std::string& name : program.samplers())
        if (const Entry* entry = find(name)) out.samplers.push_back({&name, entry, true});
    for (const std::string& block : program.blocks()) {
        const Entry* entry = find(arrayOf(block));
        if (!entry) continue;
        const std::vector<std::string>& updated = program.updated();
        const bool isUpdated = std::find(updated.begin(), updated.end(), entry->row->name) != updated.end();
        out.blocks.push_back({&block, entry, entry->row->isRecord || isUpdated});
    }
    return out;
}

ProgramOptions Arrays::passOptions(const std::string& file, const std::string& label) const {
    ProgramOptions out;
    out.label = label;
    out.arrays = table_;
    const bool textures = table_->form() == ArrayTable::Form::textures;
    (textures ? out.fragment : out.compute) = file + ".pass.glsl";
    if (!textures) return out;
    out.vertex = "passes/fullscreen.vert";
    out.defines = {"TEXTURES", concat("ROW_BITS ", sizes_.rowBits)};
    return out;
}

const Program& Arrays::use(const Program& program) const {
    program.use();
    const Uses& uses = usesOf(program);
    for (const auto& [name, entry, isRead] : uses.samplers) {
        if (entry->array.texture) program.texture(name->c_str(), entry->array.texture);
        const Texture& texture = entry->lent ? *entry->lent : entry->texture;
        if (texture) program.texture(name->c_str(), texture);
    }
    for (const auto& [block, entry, isRead] : uses.blocks)
        if (entry->array.buffer) program.storage(block->c_str(), entry->array.buffer);
    return program;
}

int Arrays::entriesADraw(const Program& program) const {
    const std::vector<std::string>& names = program.written();
    const auto lists =
        std::count_if(names.begin(), names.end(), [&](const std::string& name) { return isList(name); });
    return lists > 0 ? ArrayDeclarations::drawBuffers / int(lists) : 0;
}

bool Arrays::isList(const std::string& name) const {
    const ArrayRow& row = *entryOf(name).row;
    return row.ofList && row.packed == 1;
}

std::vector<ColorTarget> Arrays::targets(const Program& program, int firstEntry) const {
    std::vector<ColorTarget> out;
    const int entries = entriesADraw(program);
    for (const std::string& name : program.written()) {
        const Texture& texture = entryOf(name).texture;
        EXPECTS(texture && "what the pass draws into was made");
        if (!isList(name)) out.emplace_back(&texture);
        for (int e = 0; isList(name) && e < entries; ++e)
            out.emplace_back(&texture, firstEntry + e);
    }
    return out;
}

// Waits for what the program reads, and for those who read what it writes.
void Arrays::order(const Program& program) {
    const Uses& uses = usesOf(program);
    const auto among = [](const std::vector<GLuint>& buffers, const Uses::Use& use) {
        return std::find(buffers.begin(), buffers.end(), use.entry->array.buffer.id()) != buffers.end();
    };
    bool waits = false;
    for (const Uses::Use& use : uses.samplers)
        waits = waits || among(written_, use);
    for (const Uses::Use& use : uses.blocks)
        waits = waits || among(read_, use) || (use.isRead && among(written_, use));
    if (waits) settle();
    for (const Uses::Use& use : uses.samplers)
        read_.push_back(use.entry->array.buffer.id());
    for (const Uses::Use& use : uses.blocks)
        written_.push_back(use.entry->array.buffer.id());
}

void Arrays::settle() {
    if (table_->form() == ArrayTable::Form::textures) return;
    barrier({Barrier::textureFetch, Barrier::storage, Barrier::command});
    written_.clear();
    read_.clear();
}

void Arrays::run(const Program& program, int firstNumber, int numbers, int firstEntry) {
    program.set("numbers", numbers);
    program.set("firstNumber", firstNumber);
    constexpr int lanes = 64;  // of a workgroup, as the shaders say
    if (table_->form() == ArrayTable::Form::buffers) return runGroups(program, (numbers + lanes - 1) / lanes);
    ++dispatches_;
    const Framebuffer& target = framebuffers_.into(targets(program, firstEntry));
    const int first = firstNumber >> sizes_.rowBits,
              end = ((firstNumber + numbers - 1) >> sizes_.rowBits) + 1;
    target.bind(0, first, target.width(), end - first);
    drawVertices(3);
}

void Arrays::runGroups(const Program& program, int groups) {
    EXPECTS(groups <= context_->info().maxWorkGroupsX);
    ++dispatches_;
    order(program);
    program.dispatch(groups);
}

void Arrays::runIndirect(const Program& program, const std::string& record, size_t offset) {
    ++dispatches_;
    if (std::find(written_.begin(), written_.end(), buffer(record).id()) != written_.end()) settle();
    order(program);
    program.dispatchIndirect(buffer(record), offset);
}

size_t Arrays::bytes() const {
    size_t out = 0;
    for (const auto& [name, entry] : arrays_) {
        if (entry.array.buffer) out += entry.array.buffer.bytes();
        if (entry.texture) out += entry.texture.bytes();
    }
    return out;
}

}  // namespace shoal::gpu
