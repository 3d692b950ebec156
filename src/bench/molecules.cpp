
#include "bench/case.h"
#include "core/contract.h"
#include "molecule/molecule_file.h"

namespace shoal::bench {

BenchMolecules::BenchMolecules(const std::string& folder)
    : quad(readMolecule(folder + "/quad.json")),
      cross(readMolecule(folder + "/cross.json")),
      fish(readMolecule(folder + "/fish.json")),
      cloth(bench::cloth(8)) {}

const Molecule& BenchMolecules::of(const std::string& name) const {
    if (name == "quad") return quad;
    if (name == "cross") return cross;
    if (name == "fish") return fish;
    EXPECTS(name == "cloth");
    return cloth;
}

}  // namespace shoal::bench
