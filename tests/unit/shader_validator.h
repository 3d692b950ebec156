// Shaders through the reference compiler, glslangValidator, and the scenes that ask for each of them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gpu/shader_source.h"
#include "scene/scene.h"
#include "simulate/contact/facts.h"
#include "simulate/fused_kernel.h"
#include "support/scratch.h"

namespace shoal::test {

using Defines = std::vector<std::string>;

// WebGL 2's language, and the precisions that it demands.
extern const char* const header300es;

// Whether glslangValidator is installed; warns where it is not.
bool hasValidator();

// Returns the validator's complaint about a file, with its lines led back to the files that they came from.
std::string complaint(const std::string& file, const gpu::ShaderSource& source);

// Gathers shaders, each text once, and validates them together; one by one only when something is wrong.
class Validator {
  public:
    std::map<std::string, std::string> generated;
    std::string arrays;           // the folder of shaders whose table of arrays they name; empty: none
    std::set<std::string> holds;  // of the table

    void add(const std::string& file, const Defines& defines, const char* header);
    void addKernel(const Plan& plan, const KernelOptions& options);
    // A pass of contact, in the form that the facts name.
    void addContact(const std::string& pass, const ContactFacts& facts, const ContactGroupFacts& group,
                    Defines defines);
    // All that is drawn of a group in fragments.
    void addFragments(const Plan& plan, KernelOptions options);
    // For each form of the state: with TEXTURES among the defines, in layers as well. What needs a buffer is
    // not for WebGL 2. Constants (gpu::flag) are true where they are named among the defines, else false.
    void addPicture(const std::string& file, Defines defines);
    void addBoth(const std::string& file, Defines defines);  // in textures: desktop and WebGL 2
    void check() const;
    size_t count() const { return shaders_.size(); }

  private:
    struct Shader {
        std::string path, what;
        gpu::ShaderSource source;
    };
    gpu::ShaderSource resolve(const std::string& file, const Defines& defines,
                              const std::map<std::string, std::string>& texts, const char* header) const;
    void add(const std::string& file, const Defines& defines, const char* header, gpu::ShaderSource source);

    Scratch scratch_;
    std::set<std::string> seen_;
    std::vector<Shader> shaders_;
};

// Calls visit(facts) for all sets of some facts, beside those that hold anyway.
template <typename Facts, typename Visit>
void forFacts(const Facts& begin, const std::vector<bool Facts::*>& some, const Visit& visit) {
    for (size_t bits = 0; bits < size_t(1) << some.size(); ++bits) {
        Facts facts = begin;
        for (size_t i = 0; i < some.size(); ++i)
            if (bits >> i & 1) facts.*some[i] = true;
        visit(facts);
    }
}

template <typename Shape>
Field field(Shape shape, bool boxed = false) {
    Field out;
    out.shape = std::move(shape);
    if (boxed) out.box = Box{};
    return out;
}

// Every kind of field, also in a box, wrapped and of several octaves; of collider; and of force.
std::vector<Field> fieldsToValidate();
std::vector<Collider> collidersToValidate();
std::vector<Force> forcesToValidate();
// Every combination of the words given.
std::vector<Defines> combinations(const Defines& words);
std::map<std::string, std::string> generate(const std::vector<Field>& fields,
                                            const std::vector<Collider>& colliders);
// A leaf with what the words name.
Scene leafScene(const Defines& words, SolverKind solver, FieldSampling sampling);

inline constexpr SolverKind bothSolvers[] = {SolverKind::euler, SolverKind::leapfrog};
inline constexpr Lanes bothLanes[] = {Lanes::molecule, Lanes::vertex};

}  // namespace shoal::test
