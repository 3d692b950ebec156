#include "simulate/contact/facts.h"

#include "gpu/shader_source.h"

namespace shoal {

using gpu::constant;

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

std::vector<std::string> ContactFacts::defines() const {
    std::vector<std::string> out = {constant("REMEMBERS", remembers), constant("RESTS", rests),
                                    constant("STAGGERS", staggers),   constant("SWEEPS", sweeps),
                                    constant("SELF", self),           constant("SPREADS", spreads),
                                    constant("BODIES", rigid),        constant("COLLIDERS", colliders)};
    if (rests) out.emplace_back("MARKS");
    return out;
}

std::vector<std::string> ContactGroupFacts::defines() const {
    std::vector<std::string> out = {constant("RIGID", rigid), constant("TRIANGLES", triangles),
                                    constant("PINS", pins), constant("RELEASE", release)};
    if (triangles || rigid) out.emplace_back("MANY");
    if (collides) out.emplace_back("COLLIDES");
    if (severalColliders) out.emplace_back("SEVERAL_COLLIDERS");
    return out;
}

std::map<std::string, std::string> ContactGroupFacts::files() const {
    const char* sphere = vertexTextures ? "textures_sphere" : "state_sphere";
    return {{"generated/sphere.glsl", concat("#include \"contact/grid/", sphere, ".glsl\"\n")}};
}

}  // namespace shoal
