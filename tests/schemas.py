#!/usr/bin/env python3
"""Checks that the schemas are valid and accept every shipped file. Exits with 77 without python3-jsonschema."""
import json
import pathlib
import sys

try:
    from jsonschema import Draft202012Validator
except ImportError:
    print("python3-jsonschema is not installed: nothing was checked")
    sys.exit(77)

root = pathlib.Path(__file__).resolve().parent.parent
failures = 0
for schema, files in (
    ("molecules/molecule.schema.json", sorted(root.glob("molecules/*.json"))),
    ("models/scene.schema.json", sorted(root.glob("models/*/*.scene.json"))),
):
    rules = json.loads((root / schema).read_text())
    Draft202012Validator.check_schema(rules)
    validator = Draft202012Validator(rules)
    for file in files:
        if file.name.endswith(".schema.json"):
            continue
        document = json.loads(file.read_text())
        for error in validator.iter_errors(document):
            print(f"{file}: {error.json_path}: {error.message}")
            failures += 1
        # A schema that accepts anything would prove nothing.
        if validator.is_valid({**document, "noSuchKey": 1}):
            print(f"{schema} accepts an unknown key in {file}")
            failures += 1
sys.exit(1 if failures else 0)
