#!/usr/bin/env python3
"""Asks for an error of scenes drawn at random and finds, by the double-precision reference of all their molecules, whether it
holds; report.py FOLDER then makes the table and the picture of docs/accuracy.md.

claims.py FOLDER [--scenes 200]

FOLDER takes claims.csv, a row a scene and error. What is there is not asked again, so that a run goes on where it was ended;
rows of another commit are refused. tests/gl/random_scene.h tells what is drawn.
"""
import argparse
import csv
import datetime
import json
import os
import pathlib
import subprocess
import sys

errors = ("1e-2", "1e-3", "1e-4")
molecules = 24  # of a scene
found_keys = ("solver", "substeps", "after", "claimed", "above", "unknown", "found", "worst", "foundAbove", "foundUnknown")
keys = ("seed", "asked", *found_keys, "refusal", "commit", "date")
test = "what --error claims of a random scene"


def rows_of(file):
    if not file.exists():
        return []
    with open(file, newline="", encoding="utf-8") as rows:
        reader = csv.DictReader(rows)
        if tuple(reader.fieldnames or ()) != keys:
            sys.exit(f"{file}: these are not the columns that claims.py writes: give another folder")
        return list(reader)


def ask(seed, error, tests):
    said = subprocess.run([tests, test], env=os.environ | {"SHOAL_CLAIM": f"{seed} {error}"}, capture_output=True, text=True,
                          check=False)
    for line in said.stdout.splitlines():
        kind, _, rest = line.partition(",")
        if kind == "claim":
            return dict(zip(found_keys, rest.split(",")))
        if kind == "refusal":
            return {"refusal": rest}
    sys.exit(f"scene {seed}, error {error}: {tests} said neither a claim nor a refusal:\n{said.stdout}{said.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scenes", type=int, default=200)
    parser.add_argument("--shoal", default=os.environ.get("SHOAL_COMMAND", "build/shoal"), help="the command")
    parser.add_argument("--tests", default="build/tests/shoal-gl", help="the tests that ask")
    given = parser.parse_args()
    said = subprocess.run([given.shoal, "info", "--json"], stdout=subprocess.PIPE, check=False)
    commit = json.loads(said.stdout)["commit"]
    given.folder.mkdir(parents=True, exist_ok=True)
    file = given.folder / "claims.csv"
    rows = rows_of(file)
    for row in rows:
        if row["commit"] != commit:
            sys.exit(f"{file}: scene {row['seed']} is of commit {row['commit']}, and {given.shoal} is of {commit}: "
                     "give another folder")
    known = {(row["seed"], row["asked"]) for row in rows}
    with open(file, "a", newline="", encoding="utf-8") as out:
        writer = csv.DictWriter(out, keys, lineterminator="\n")
        if not rows:
            writer.writeheader()
        for seed in range(1, given.scenes + 1):
            for error in errors:
                if (str(seed), error) in known:
                    continue
                print(f"scene {seed} of {given.scenes}, error {error}", file=sys.stderr)
                date = datetime.date.today().isoformat()
                writer.writerow({"seed": seed, "asked": error, "commit": commit, "date": date} | ask(seed, error, given.tests))
                out.flush()


if __name__ == "__main__":
    main()
