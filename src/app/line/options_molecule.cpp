#include "app/line/cli.h"
#include "app/line/commands.h"

#include <filesystem>

#include <algorithm>

#include "app/line/options.h"
#include "author/from_mesh.h"
#include "author/shapes.h"

namespace shoal::app {

namespace {

// Declares the options of all that is made of a mesh.
void addMaking(CLI::App& command, Options& options) {
    MoleculeOptions& molecule = options.molecule;
    FromMesh& make = molecule.fromMesh;
    const auto number = [&](const char* name, std::optional<double>& value, const std::string& what) {
        addNumber(command, name, value, what, "a number");
    };
    command.add_flag("--force", molecule.force, "Write over a file that is there");
    std::vector<std::string> names;
    for (const ScaledMaterial& material : materialScale())
        names.emplace_back(material.name);
    command.add_option("--material", make.material, "What it is of (default flesh; of a sheet leaf)")
        ->type_name(joined(names, "|"));
    number("--mass", make.mass, "kg, in all (default: from the material)");
    number("--density", make.density, "kg/m^3, instead of the material's");
    number("--modulus", make.modulus, "Pa, Young's modulus, instead of the material's");
    number("--thickness", make.thickness, "m, of a sheet, instead of the material's");
    number("--frequency", make.frequency, "Hz, the lowest, instead of the material's");
    number("--damping", make.damping, "Ratio of the lowest frequency, instead of the material's");
    addReads(command, "--pin",
             "Pin what meets a rule: y<0.1 (share of the box) or y<0.02m (metres); repeatable",
             [&make](const std::string& text) { make.pins.rules.push_back(parsePinRule(text)); });
    command.add_option("--name", make.name, "Of the molecule (default: that of the file)");
    addFile(command, "--texture", molecule.texture, "PNG beside the molecule file");
    addRead(command, "--color", "Linear RGB: red, or 0.2,0.5,0.1", [&molecule](const std::string& text) {
        parsePaint(text);
        molecule.color = text;
    });
    command.add_flag("--json", options.json, "Report as JSON on standard output");
    addFile(command, "--report", molecule.report,
            "Page to write (.html): the molecule, its motions, warnings")
        ->check(endsIn({".html"}));
}

void addFromMesh(CLI::App& command, Options& options) {
    MoleculeOptions& molecule = options.molecule;
    FromMesh& make = molecule.fromMesh;
    addFile(command, "mesh", options.files,
            "Mesh as OBJ, PLY, glTF or 3MF, or of any format that Assimp reads")
        ->required()
        ->expected(1);
    addFile(command, "-o,--output", molecule.output, "Molecule file (.json); without it nothing is written")
        ->check(endsIn({".json"}));
    addWhole(command, "--vertices", make.vertices,
             "At most so many are simulated (default 24, of a cage 40)");
    addWhole(command, "--rings", make.rings,
             "Instead: so many rings of four vertices along the longest side");
    addWord(command, "--springs", make.springs,
            "lattice: tetrahedra that fill the volume; cage: about all parts",
            {"auto", "surface", "lattice", "cage"});
    addNumber(command, "--size", make.size, "m, of the longest side (default: as in the file)", "a number");
    addRead(command, "--forward", "Turn it so that this axis of the mesh (+X, --forward=-X) becomes +Z",
            [&make](const std::string& text) { make.forward = parseAxis(text); })
        ->type_name("AXIS");
    command.add_flag("--centre,--center", make.centre, "Put the middle of its box at the origin");
    command.add_option("--pin-name", make.pins.names,
                       "Pin an object, mesh, material or bone of the file by name");
    addReads(command, "--pin-paint", "Pin what is painted in this vertex colour: red, or 1,0.5,0",
             [&make](const std::string& text) {
                 parsePaint(text);
                 make.pins.paints.push_back(text);
             });
    addReads(command, "--pin-near",
             "Pin the vertex nearest to a point of the box: 0.5,1,0.5 is the middle of its top",
             [&make](const std::string& text) { make.pins.points.push_back(parsePinPoint(text)); });
    command.add_flag_callback(
        "--no-skin", [&make] { make.skin = false; }, "Draw the few triangles themselves");
    addWhole(command, "--skin-triangles", make.skinTriangles,
             "Simplify the skin to about so many, for large numbers of molecules");
    addMaking(command, options);
}

void addNew(CLI::App& command, Options& options) {
    MoleculeOptions& molecule = options.molecule;
    addFile(command, "molecule", options.files, "Molecule file to write (.json)")
        ->required()
        ->expected(1)
        ->check(endsIn({".json"}));
    command.add_option("--shape", molecule.shape, "What it begins as")
        ->check(oneOf(shapeNames()))
        ->type_name(joined(shapeNames(), "|"))
        ->capture_default_str();
    addWhole(command, "--divisions", molecule.divisions, "Of its longest side (default: the shape's)");
    addNumber(command, "--size", molecule.fromMesh.size, "m, of the longest side (default 0.2)", "a number");
    addMaking(command, options);
}

void addShow(CLI::App& command, Options& options) {
    addFile(command, "molecule", options.files, "Molecule file")->required()->expected(1);
    addFile(command, "--capture", options.capture, "Picture to write (.png), required")->required();
    addSize(command, options, "Of the picture in pixels")->default_str("1280x760");
}

void finishShow(Options& options, bool sized) {
    if (!sized) options.width = 1280, options.height = 760;
    if (options.width < 480 || options.height < 240 || options.width < options.height * 5 / 4)
        throw Error(concat("--size: a sheet needs at least 480x240 pixels and is wider than high, found ",
                           options.width, "x", options.height));
}

// Errors of checkOptions() begin with the option's name.
void finishMaking(MoleculeOptions& molecule, const std::string& file) {
    FromMesh& make = molecule.fromMesh;
    if (make.name.empty())
        make.name = std::filesystem::path(molecule.output.empty() ? file : molecule.output).stem().string();
    try {
        checkOptions(make);
    } catch (const Error& error) {
        throw Error(concat("--", error.message()));
    }
}

void finishShape(const MoleculeOptions& molecule) {
    const Shape& shape = shapeNamed(molecule.shape);
    try {
        checkDivisions(shape, molecule.divisions.value_or(shape.divisions));
    } catch (const Error& error) {
        throw Error(concat("--divisions: ", error.message()));
    }
}

}  // namespace

void addMolecule(CLI::App& app, Options& options) {
    CLI::App* molecule = app.add_subcommand("molecule", "Make and draw molecules");
    molecule->require_subcommand(1);
    addFromMesh(*molecule->add_subcommand("from-mesh", "Make a molecule, with its skin, from any mesh"),
                options);
    addNew(*molecule->add_subcommand("new", "Make a molecule of a plain shape, to be changed"), options);
    addShow(*molecule->add_subcommand("show", "Draw a molecule, its springs and motions on one sheet"),
            options);
}

void finishMolecule(const CLI::App& app, Options& options) {
    const CLI::App* molecule = app.get_subcommand("molecule");
    if (!molecule->parsed()) return;
    if (molecule->get_subcommand("from-mesh")->parsed()) {
        options.command = moleculeFromMeshCommand;
        finishMaking(options.molecule, options.files.front());
    }
    if (molecule->get_subcommand("new")->parsed()) {
        options.command = moleculeNewCommand;
        options.molecule.output = options.files.front();
        finishMaking(options.molecule, options.files.front());
        finishShape(options.molecule);
    }
    if (molecule->get_subcommand("show")->parsed()) {
        options.command = moleculeShowCommand;
        finishShow(options, molecule->get_subcommand("show")->count("--size") > 0);
    }
}

}  // namespace shoal::app
