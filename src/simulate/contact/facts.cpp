#include "simulate/contact/facts.h"

#include "gpu/shader_source.h"

namespace shoal {

using gpu::constant;

namespace {

// A file in memory that includes one of several.
std::pair<std::string, std::string> chosen(const char* name, const char* file) {
    return {concat("generated/", name, ".glsl"), concat("#include \"contact/", file, ".glsl\"\n")};
}

}  // namespace

ContactFacts contactFacts(const Plan& plan, bool textures, bool fused, bool counts) {
    ContactFacts out;
    out.textures = textures;
    out.fused = fused;
    out.counted = !textures && counts;
    out.remembers = plan.contact.remembers();
    out.rests = !textures && plan.contact.settings.rest.has_value();
    out.staggers = plan.contact.settings.search == ContactSearch::staggered;
    out.sweeps = plan.contact.settings.fastest.has_value();
    for (const ContactGroup& group : plan.contact.groups) {
        out.self |= group.self;
        if (!out.remembers) continue;
        out.rigid |= plan.groups[group.group].rigid;
        out.spreads |= group.triangles || plan.groups[group.group].rigid;
        out.colliders |= fused && plan.groups[group.group].needs.collide;
    }
    return out;
}

std::set<std::string> ContactFacts::names() const {
    std::set<std::string> out;
    const std::pair<bool, const char*> facts[] = {
        {fused, "fused"},     {counted, "counted"},     {remembers, "remembers"},
        {rests, "rests"},     {staggers, "staggers"},   {self, "self"},
        {spreads, "spreads"}, {colliders, "colliders"}, {rigid, "rigid"}};
    for (const auto& [holds, name] : facts)
        if (holds) out.insert(name);
    return out;
}

std::vector<std::string> ContactFacts::constants() const {
    return {constant("REMEMBERS", remembers), constant("RESTS", rests),        constant("STAGGERS", staggers),
            constant("SWEEPS", sweeps),       constant("SELF", self),          constant("SPREADS", spreads),
            constant("BODIES", rigid),        constant("COLLIDERS", colliders)};
}

std::map<std::string, std::string> ContactFacts::files() const {
    return {chosen("key", counted ? "grid/key_counted" : "grid/key_sorted"),
            chosen("list", textures ? "search/texture_list" : "search/buffer_list"),
            chosen("mark_groups", rests ? "rest/mark_groups" : "rest/no_mark_groups")};
}

std::vector<std::string> ContactGroupFacts::constants() const {
    return {constant("RIGID", rigid), constant("TRIANGLES", triangles), constant("MANY", triangles || rigid),
            constant("PINS", pins), constant("RELEASE", release)};
}

std::map<std::string, std::string> ContactGroupFacts::files() const {
    return {chosen("sphere", vertexTextures ? "grid/textures_sphere" : "grid/state_sphere"),
            chosen("sphere_colliders", collides ? "grid/near_colliders" : "grid/no_colliders"),
            chosen("search_colliders", severalColliders ? "grid/several_colliders" : "grid/one_collider")};
}

}  // namespace shoal
