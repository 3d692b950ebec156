#include "simulate/contact/data.h"

#include <algorithm>
#include <bit>

#include "sort/radix_sort.h"

namespace shoal {

using gpu::Program;

namespace {

constexpr size_t contactLanes = 64;  // of a workgroup, as the shaders say
constexpr size_t lineWords = 32;     // of a GPU's cache

// Words of the counts of so many cells and of their tiles (shaders/contact/grid/cell_counts.glsl).
size_t countWords(size_t cells) {
    return cells + (cells + ContactData::cellTile - 1) / ContactData::cellTile * lineWords;
}

// Words of an entry of the largest array of lists.
size_t entryWords(const ContactPlan& contact) {
    return contact.remembers() ? 4 : 1;
}

// Entries of all lists together.
size_t mostEntries(const gpu::ContextInfo& info, const ContactPlan& contact) {
    return std::min(size_t(info.maxStorageBlockBytes) / (entryWords(contact) * sizeof(uint32_t)),
                    size_t(info.maxBufferTexels));
}

// Spheres for whose table of cells there is room.
size_t mostOfTable(const gpu::ContextInfo& info) {
    const size_t words =
        std::min(size_t(info.maxStorageBlockBytes) / sizeof(uint32_t), size_t(info.maxBufferTexels));
    size_t cells = std::bit_floor(words);
    while (countWords(cells) > words)
        cells /= 2;
    return cells / 2;
}

const ContactPlan* checkedInBuffers(const gpu::ContextInfo& info, const ContactPlan& contact) {
    const size_t most = ContactData::most(info, contact);
    if (size_t(contact.spheres) <= most) return &contact;
    throw Error(contact.settings.location,
                concat("contact between ", contact.spheres,
                       " spheres is more than this context holds: at most ", most));
}

}  // namespace

size_t ContactData::most(const gpu::ContextInfo& info, const ContactPlan& contact) {
    return std::min({mostEntries(info, contact) / shortestList,
                     size_t(info.maxStorageBlockBytes) / sizeof(glm::vec4),
                     size_t(info.maxWorkGroupsX) * contactLanes, RadixSort::most(info), mostOfTable(info)});
}

ContactData::ContactData(gpu::Context& usedContext, const Plan& usedPlan, const Tables& usedTables,
                         ContactState& usedState, std::optional<bool> asOnGpu)
    : ContactFacts(contactFacts(usedPlan, usedState.form() == ContactState::Form::textures, usedState.fused(),
                                asOnGpu.value_or(!usedContext.info().software))),
      context(&usedContext),
      plan(&usedPlan),
      contact(textures ? &plan->contact : checkedInBuffers(context->info(), plan->contact)),
      tables(&usedTables),
      state(&usedState),
      padded((size_t(contact->spheres) + contactLanes - 1) / contactLanes * contactLanes),
      listLength(textures ? contactsInFragments
                          : int(std::min(size_t(contact->listLength),
                                         mostEntries(context->info(), *contact) / padded))),
      table(context->shaders() + "/contact/arrays.txt", state->form(), names()),
      arrays(*context, table, sizes(), "contact") {
    giveTables();
}

gpu::ArraySizes ContactData::sizes() const {
    const size_t spheres = textures ? size_t(contact->spheres) : padded;
    const size_t cells = contact->cells();
    return {{{"sphere", spheres},
             {"slot", spheres},
             {"row", spheres},
             {"key", cells},
             {"counters", countWords(cells)}},
            size_t(listLength),
            rowBits(cells)};
}

// Gives the arrays that never change.
void ContactData::giveTables() {
    std::vector<glm::vec4> shapes, materials;
    for (const ContactGroup& group : contact->groups) {
        firstShapes_.push_back(int(shapes.size()));
        shapes.insert(shapes.end(), group.shapes.begin(), group.shapes.end());
    }
    for (const glm::vec2& pair : contact->pairs)
        materials.emplace_back(pair, contact->groups[materials.size() / contact->groups.size()].soft, 0);
    arrays.give("shapes", shapes.data(), shapes.size());
    arrays.give("materials", materials.data(), materials.size());
    if (textures && remembers) arrays.alias("oldImpulses", "impulses");
    if (!self && !rests && !spreads) return;
    std::vector<uint32_t> words;
    std::vector<glm::uvec4> groups;
    for (const ContactGroup& group : contact->groups) {
        groups.emplace_back(group.firstSphere, group.spheresOf, words.size(), group.wordsOf);
        groups.emplace_back(planOf(group).vertexCount, firstShapes_[size_t(&group - contact->groups.data())],
                            0, 0);
        words.insert(words.end(), group.apart.begin(), group.apart.end());
    }
    if (self) arrays.give("apart", words.data(), words.size());
    arrays.give("groupsOf", groups.data(), groups.size());
}

gpu::ProgramOptions ContactData::options(const std::string& file, const std::string& label) const {
    gpu::ProgramOptions out = arrays.passOptions(file, concat("contact ", label));
    out.defines.insert(out.defines.end(),
                       {concat("MOST_COLLIDERS ", ContactPlan::mostColliders), concat("LIST ", listLength)});
    const auto define = [&](bool need, const std::string& name) {
        if (need) out.defines.push_back(name);
    };
    define(counted, concat("CELL_TILE ", cellTile));
    define(counted, concat("LINE_WORDS ", lineWords));
    for (const std::string& fact : ContactFacts::defines())
        out.defines.push_back(fact);
    return out;
}

static std::string stageName(const std::string& file, const std::string& name) {
    return name.empty() ? file.substr(file.rfind('/') + 1) : name;
}

Program ContactData::stage(const std::string& file, const std::vector<std::string>& defines,
                           const std::string& name) const {
    gpu::ProgramOptions made = options(file, stageName(file, name));
    made.defines.push_back(concat("NEIGHBORS ", contact->settings.neighbors));
    made.defines.push_back(concat("NEAR ", ContactPlan::near));
    made.defines.insert(made.defines.end(), defines.begin(), defines.end());
    return Program(*context, made);
}

Program ContactData::groupStage(const ContactGroup& group, const std::string& file,
                                const std::vector<std::string>& defines, const std::string& name) const {
    const GroupPlan& groupPlan = planOf(group);
    gpu::ProgramOptions made = options(file, concat(stageName(file, name), " of ", groupPlan.name));
    const ContactGroupFacts facts = {.rigid = isRigid(group),
                                     .triangles = group.triangles,
                                     .pins = groupPlan.needs.pins,
                                     .release = groupPlan.needs.release,
                                     .collides = !textures && collides(group),
                                     .severalColliders = plan->jointContact,
                                     .vertexTextures = textures && !fused};
    for (const std::vector<std::string>& more :
         {state->defines(group.group), group.defines(), facts.defines(), defines})
        made.defines.insert(made.defines.end(), more.begin(), more.end());
    made.defines.push_back(concat("VERTICES ", groupPlan.vertexCount));
    made.defines.push_back(concat("SPHERES ", group.spheresOf));
    made.generated = facts.files();
    made.generated["generated/colliders.glsl"] = plan->colliders.source;
    return Program(*context, made);
}

void ContactData::setTimes(const Program& program, const ContactStep& times) {
    program.set("stepTime", float(times.step));
    program.set("restSpeed", float(times.restSpeed));
}

const Program& ContactData::withResponse(const Program& program, const ContactStep& times) const {
    use(program).set("count", contact->spheres);
    program.set("cell", float(contact->cell));
    program.set("groupCount", int(contact->groups.size()));
    if (!textures) program.set("listStride", int(padded));
    setTimes(program, times);
    return program;
}

const Program& ContactData::withPart(const Program& program, const ContactGroup& group, size_t part) const {
    use(program);
    state->bind(program, group.group, part);
    if (program.uses("firstShape"))
        program.set("firstShape", firstShapes_[size_t(&group - contact->groups.data())]);
    return program;
}

void ContactData::runResponding(const Program& program) {
    if (textures)
        runAll(program);
    else
        arrays.runIndirect(program, "batches", 0);
}

void ContactData::setColliders(const Program& program, const ContactGroup& group, const Frame& frame) const {
    const std::vector<glm::vec4> parameters = colliderParameters(*plan, planOf(group), frame);
    program.set("colliderParameters", std::span<const glm::vec4>(parameters));
    tables->bind(program, *plan);
}

}  // namespace shoal
