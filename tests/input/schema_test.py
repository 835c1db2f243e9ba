"""The JSON Schema against model files: schema_test.py SCABO BAD_FOLDER GOOD_FOLDER...

`scabo schema` is a valid draft 2020-12 schema, accepts every good file and every model in the documents, rejects
the bad files whose mistake is one of structure, and allows no unknown key anywhere. The program reads and divides every good file, and
there is no key that none of them has.
"""

import json
import pathlib
import re
import subprocess
import sys
import unittest

import jsonschema
import yaml

SCHEMA = BAD = GOOD = None

# Kinds of mistakes that no schema can see (names that must exist, geometry, sizes, the model as a whole) or that
# a reader of YAML sees before it.
BEYOND_SCHEMA = re.compile(
    r"syntax_|key_repeated|key_is_a_list|number_(underscores|infinite|nan|overflow)"
    r"|material_(incompressible_plane_strain|unknown|section_missing)"
    r"|large_slip_of_rigid|body_(unsupported|rigid_without_contact)"
    r"|polygon_(?!two_vertices|vertex_of_three)|outline_(not_|full_circle|arc_radii|arc_crosses|arc_swallows"
    r"|name_twice|without_area)"
    r"|shape_too_|centre_|mesh_(1e9|too_many|(quadtree|polygons)_of_a_sliver|min_size_(of|above)|refine_(of|on_un)|tolerance_of_a_body|quadtree_centre)"
    r"|bars_(in_the|on_a_|of_one|tightened_in|in_time|history)|bed_|repeat_around_by|springs_(both_zero|leave_|named_|of_|on_|at_rest_(named|never|of_one|without_stiffness))|field_(below_|on_|with_szz)|moment_on_|pores_(in_no|over_|enter_)|load_enters_an_edge|rotation_(of_an|beside_a_direction)"
    r"|revolution_|load_spin_|stage_|fit_|restart_|symmetry_(?!of_nothing)"
    r"|body_thickness_(in_plane|of_rev)|image_|tie_(all_|with_itself|rigid|of_body_and|of_corner|nothing|and_contact|apart)|repeat_one_step|contact_(reach_between|edge_and|all_touch)|hole_(outside|crosses|named|too_)|regions?_(of_unknown|of_the_same|outside|overlap|in_a_hole|too_)|outside_of_polygons"
    r"|place_(unknown|near_far|near_a_rigid)"
    r"|dynamic_(?!damping)|added_mass_|point_mass_|growth_(?!toughness(?!_of_(?:region_missing|material))|nothing|law|criterion|distance_zero|break)|limit_(?!of_nothing|too_wide)|initial_without_time|space_"
    r"|cad_runs_|solver_tolerance_below_"
    r"|imported_(no_|folded|cut_off|empty|apart|unknown_(region|material|edge)|material_of|region_without|polygon_as|cell_without)"
    r"|forces_per_radian_|support_(conflict|name_|formula_(of_a_point|unknown|without))|load_(on_unknown|moving_|force_on|pressure_on|traction_on|gravity_|none|section_empty)"
    r"|contact_(with_itself|unknown_edge|twice|of_two_rigid|at_a_corner)"
    r"|crack_(across_a_hole|name_twice|of_no_length|on_a_border|on_a_crack|on_an_edge|out_of_its_body)"
    r"|crack_(and_centre|contact_|path_(face_|in_one|mouth|outside|point_twice)|two|face_|in_finite|mouth_(inside|on_a|unknown)|named_like|tip_)|face_(points_(twice|xi)|power_|powers_on)|notch_"
    r"|quantity_|sectors?_|output_(body_unknown|line_without|name_twice)|place_two_dots|outside_(gravity|temperature|in_finite|face_)|reference_|anisotropic_not|orthotropic_(nu12|third|and_young)"
    r"|edge_load_(not_asc|off_|on_a_body|third|values_missing)|water_(on_a_corner|up_zero)"
    r"|support_(normal_of|normal_and_|along_zero)|temperature_(on_an|without|radial_(negative|in_one|with_a_bar)|table_(bends|goes_back|in_finite|not_ascending|of_a_point|off_its))|body_force_on_a|law_(dynamic_(backward_)?above|along_not_ascending)|number_underflow|modal_|step_(unknown|name_twice|never|names|increments_(smallest_above|first_above))|later_|imported_crack|parameter_(?!of_)"
    r"|history_(contact_unknown|stress_of_a_rigid_body|broken_|factor_of_|moment_of_|pore_|section_of|section_outside|axes_(of_an_|word|not_finite)|displacement_unknown|edge_(is_|of_|unknown))|slip_large_(curved|with_tol|in_stages)|size_auto_|property_(unknown$)|curve_(unknown|jumps|not_asc|ramp_back|over_(?!no_length))|step_(cycles|factor_is|friction_(unknown|of_a))")


class Loader(yaml.SafeLoader):
    """YAML 1.2's core types, as editors and Scabo read them (in YAML 1.1 `on` is true and 10e9 a text)."""


Loader.yaml_implicit_resolvers = {}
for tag, pattern, first in [
    ("bool", r"^(?:true|false)$", "tf"),
    ("null", r"^(?:~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("int", r"^[-+]?[0-9]+$", "-+0123456789"),
    ("float", r"^[-+]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?$", "-+.0123456789"),
    ("merge", r"^<<$", "<"),
]:
    Loader.add_implicit_resolver(f"tag:yaml.org,2002:{tag}", re.compile(pattern), list(first))
Loader.add_constructor("tag:yaml.org,2002:float", lambda loader, node: float(node.value))
Loader.add_constructor("tag:yaml.org,2002:int", lambda loader, node: int(node.value, 10))


def load(text):
    return yaml.load(text, Loader)


def mistakes(model):
    return [error.message for error in jsonschema.Draft202012Validator(SCHEMA).iter_errors(model)]


def good_files():
    return [file for folder in GOOD if folder.name == "good" for file in sorted(folder.iterdir()) if file.suffix in (".yaml", ".json")]


def documented_models():
    """Whole models in ```yaml blocks of Markdown files."""
    for folder in GOOD:
        for page in sorted(folder.rglob("*.md")):
            for block in re.findall(r"```yaml\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL):
                if re.search(r"^scabo: 1", block, re.MULTILINE) and "bodies:" in block:
                    yield page, block


class ModelSchema(unittest.TestCase):
    def test_every_key_has_a_description(self):
        """Of its own, or that of what it refers to; editors show it."""
        def is_described(key):
            return "description" in key or ("$ref" in key and is_described(SCHEMA["$defs"][key["$ref"].rpartition("/")[2]]))

        def without(node, path=""):
            if isinstance(node, list):
                return [found for item in node for found in without(item, path)]
            if not isinstance(node, dict):
                return []
            keys = node.get("properties", {}) if not re.search(r"/(if|then|else|not)\b", path) else {}
            return [f"{path}: {name}" for name, key in keys.items() if isinstance(key, dict) and not is_described(key)] + [
                found for name, item in node.items() for found in without(item, f"{path}/{name}")]

        self.assertEqual(without(SCHEMA), [])

    def test_is_a_valid_schema(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_accepts_good_files(self):
        files = [file for folder in GOOD for kind in ("*.yaml", "*.json") for file in sorted(folder.rglob(kind))]
        # PyYAML takes no tabs, so JSON files are read as what they are.
        models = [(file, (json.loads if file.suffix == ".json" else load)(file.read_text(encoding="utf-8")))
                  for file in files]
        models = [(file, model) for file, model in models if isinstance(model, dict) and "bodies" in model]
        self.assertGreaterEqual(len(models), 5)
        for file, model in models:
            with self.subTest(file=str(file)):
                self.assertEqual(mistakes(model), [])

    def test_the_program_reads_the_good_files(self):
        for file in good_files():
            with self.subTest(file=file.name):
                done = subprocess.run([sys.argv[1], "check", str(file)], capture_output=True, text=True, timeout=1200)
                if "built without Gmsh's library" in done.stderr:
                    continue
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_every_key_is_in_some_good_file(self):
        """Keys of the schema as (what holds them, key): mesh and solver have a 'tolerance' each."""
        wanted, found, without_value = set(), set(), set()

        def keys_of(schema, value, name):
            if "$ref" in schema:
                target = schema["$ref"].rsplit("/", 1)[-1]
                if value is None and target in without_value:
                    return  # shapes may have shapes
                if value is None:
                    without_value.add(target)
                return keys_of(SCHEMA["$defs"][target], value, target)
            for key, inner in schema.get("properties", {}).items():
                wanted.add((name, key))
                if isinstance(value, dict) and key in value:
                    found.add((name, key))
                keys_of(inner, value.get(key) if isinstance(value, dict) else None, f"{name}.{key}")
            if isinstance(schema.get("additionalProperties"), dict):
                for inner in (value.values() if isinstance(value, dict) and value else [None]):
                    keys_of(schema["additionalProperties"], inner, name + ".*")
            if "items" in schema:
                for inner in (value if isinstance(value, list) and value else [None]):
                    keys_of(schema["items"], inner, name + "[]")
            for choice in schema.get("oneOf", []):
                if set(choice) - {"required"}:
                    keys_of(choice, value, name)

        for file in good_files():
            text = file.read_text(encoding="utf-8")
            keys_of(SCHEMA, (json.loads if file.suffix == ".json" else load)(text), "model")
        self.assertGreaterEqual(len(wanted), 100)
        self.assertEqual(sorted(wanted - found), [])

    def test_the_fuzzers_dictionary_has_every_key(self):
        words = (pathlib.Path(__file__).parents[1] / "fuzz" / "read_model.dict").read_text(encoding="utf-8")

        def keys(schema):
            if isinstance(schema, dict):
                for key, inner in schema.items():
                    if key == "properties":
                        yield from inner
                    yield from keys(inner)
            elif isinstance(schema, list):
                for inner in schema:
                    yield from keys(inner)

        self.assertEqual(sorted(key for key in set(keys(SCHEMA)) if not re.search(rf"\b{key}\b", words)), [])

    def test_accepts_models_in_the_documents(self):
        blocks = list(documented_models())
        self.assertGreaterEqual(len(blocks), 1)
        for page, block in blocks:
            with self.subTest(page=str(page), block=block[:80]):
                self.assertEqual(mistakes(load(block)), [])

    def test_rejects_what_is_wrong_in_structure(self):
        rejected = 0
        for file in sorted(BAD.glob("*.yaml")):
            if BEYOND_SCHEMA.match(file.stem):
                continue
            with self.subTest(file=file.name):
                self.assertNotEqual(mistakes(load(file.read_text(encoding="utf-8"))), [])
                rejected += 1
        self.assertGreaterEqual(rejected, 60)

    def test_allows_no_unknown_key(self):
        def objects(schema, path):
            if isinstance(schema, dict):
                parts = path.split("/")
                if "properties" in schema and "if" not in parts and parts[-1] not in ("then", "else"):
                    yield path, schema
                for key, inner in schema.items():
                    yield from objects(inner, f"{path}/{key}")
            elif isinstance(schema, list):
                for number, inner in enumerate(schema):
                    yield from objects(inner, f"{path}/{number}")

        for path, schema in objects(SCHEMA, ""):
            with self.subTest(path=path):
                self.assertIs(schema.get("additionalProperties"), False)


if __name__ == "__main__":
    output = subprocess.run([sys.argv[1], "schema"], capture_output=True, text=True, check=True, timeout=1200).stdout
    SCHEMA = json.loads(output)
    BAD, *GOOD = [pathlib.Path(argument).resolve() for argument in sys.argv[2:]]
    unittest.main(argv=sys.argv[:1])
