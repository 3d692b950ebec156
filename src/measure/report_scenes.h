// The scenes of the accuracy report, and its tables.
//
// Three molecules, four motions, four stiffnesses. Their numbers are those of a prototype with z up; here
// (x, z, -y).
//
// Molecules have masses of 1 and springs of stiffness k with a damping of 0.05 sqrt(k), are centred on the
// origin and start turned by 0.7 rad about (1, 2, 3); the others of a group are turned at random, so that
// more than one direction counts. There is no contact of molecules: all start where the fields are.
//
//   fall     in a shear flow, drag 1 /s, gravity
//   gusts    two vertices pinned, in a shear flow with four oscillations, drag 2 /s, gravity
//   spin     20 rad/s, no drag, no gravity
//   impact   thrown onto a plane with restitution 0.5 and friction 0.3, no drag
#pragma once

#include <string>
#include <vector>

#include "measure/accuracy.h"
#include "measure/calibrate.h"
#include "scene/scene.h"

namespace shoal::measure {

Molecule foldedLeaf(double stiffness);   // 4 vertices, 6 springs
Molecule bracedCross(double stiffness);  // 10 vertices, 29 springs
Molecule slenderFish(double stiffness);  // 24 vertices, 96 springs

struct ReportScene {
    std::string id;                // of its file: "leaf-fall-1e4"
    std::string molecule, motion;  // for people
    double stiffness = 0;          // N/m
    double duration = 1;           // s
    Scene scene;
};

// Hz: long frames, because methods are compared by what their steps cost. At the 60 of a demo, reading and
// writing the state takes as long as several steps, and a method with few long ones gains less.
inline constexpr double reportFrameRate = 5;

inline constexpr const char* reportMolecules[] = {"leaf", "cross", "fish"};
inline constexpr const char* reportMotions[] = {"fall", "gusts", "spin", "impact"};
inline constexpr double reportStiffnesses[] = {1e2, 1e4, 1e6, 1e8};

// Molecule by molecule, motion by motion, by growing stiffness; `count` molecules in each.
std::vector<ReportScene> reportScenes(int count);

// One scene of the report, measured.
struct ReportEntry {
    std::string molecule, motion;
    double stiffness = 0;
    AccuracyReport accuracy;            // points, chaotic
    std::optional<Calibration> chosen;  // without candidates
};

// The tables, in Markdown.
// Tells which solver is cheapest at `error` and how many times as fast as euler; a row a motion and molecule,
// a column a stiffness.
std::string speedUpTable(const std::vector<ReportEntry>& entries, double error);
// Nanoseconds per vertex and simulated second of every solver at `error`; a row a scene.
std::string costTable(const std::vector<ReportEntry>& entries, double error);
// The method and substeps that the calibration chooses for its error.
std::string chosenTable(const std::vector<ReportEntry>& entries);

}  // namespace shoal::measure
