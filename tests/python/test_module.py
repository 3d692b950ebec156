"""The Python module, as a user has it. Run by ctest; alone: PYTHONPATH=build/python python3 -m pytest tests/python"""
import ast
import inspect
import os
import pathlib
import pydoc
import shutil
import signal
import subprocess
import sys
import gc
import threading
import time

import numpy as np
import pytest

import shoal

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAIR = {
    "name": "pair",
    "vertices": [{"position": [0, 0, 0], "mass": 0.5}, {"position": [1, 0, 0], "mass": 0.5}],
    "springs": [{"a": 0, "b": 1, "stiffness": 100}],
}


def pairs(count=1, **more):
    items = [{"position": [3 * i, 0, 0]} for i in range(count)]
    return shoal.Scene({"groups": [{"molecule": PAIR, "place": {"on": "list", "items": items}}], **more})


@pytest.fixture
def hello():
    with shoal.Simulation(shoal.Scene("hello")) as simulation:
        yield simulation


def test_state_has_shapes_and_types(hello):
    assert hello.groups == ["leaf"]
    for values, kind in ((hello.positions(), np.float64), (hello.velocities(0), np.float64), (hello.normals("leaf"), np.float32)):
        assert values.shape == (20, 9, 3) and values.dtype == kind
    assert hello.alive().shape == (20,) and hello.alive().all()


def test_steps_are_the_command_s(hello):
    hello.step(30)
    assert hello.frames == 30 and hello.time == pytest.approx(0.5)
    command = os.environ.get("SHOAL_COMMAND", ROOT / "build/shoal")
    report = subprocess.run(
        [command, "run", "hello", "--headless", "--frames", "30", "--json", "--context", "egl"], capture_output=True, text=True
    )
    assert f'"hash": "{hello.hash()}"' in report.stdout


def test_free_fall_is_free_fall():
    with shoal.Simulation(pairs(2, gravity=[0, -10, 0])) as simulation:
        start = simulation.positions()
        simulation.step(60)
        assert simulation.positions()[..., 1] - start[..., 1] == pytest.approx(-5, rel=1e-4)
        assert simulation.velocities()[..., 1] == pytest.approx(-10, rel=1e-5)


def test_energy_of_a_stretched_spring_is_kept():
    with shoal.Simulation(pairs(), solver="leapfrog", substeps=16) as simulation:
        places = simulation.positions()
        places[0, 1, 0] += 0.1
        simulation.set_state(positions=places)
        assert simulation.energy()["elastic"] == pytest.approx(0.5 * 100 * 0.1**2, rel=1e-5)
        simulation.step(100)
        energy = simulation.energy()
        assert energy["kinetic"] + energy["elastic"] == pytest.approx(0.5, rel=1e-3)


def test_a_run_tells_strain_and_error():
    with shoal.Simulation(pairs(2, gravity=[0, -10, 0]), solver="rk4") as simulation:
        first = simulation.positions()
        first[:, 1, 0] = first[:, 0, 0] + [1.1, 1.2]
        simulation.set_state(positions=first)
        told = simulation.diagnostics()
        assert told["strain"] == pytest.approx(0.2, rel=1e-5) and told["rms_strain"] == pytest.approx(0.025**0.5, rel=1e-5)
        assert told["error"] is None and told["overlap"] is None and told["error_molecules"] == 0
        for _ in range(60):
            simulation.step(1)
        told = simulation.diagnostics()
        assert told["error_duration"] == pytest.approx(1)
        assert told["frame"] == 60 and told["error_molecules"] == 2 and told["error_unknown"] == 0
        assert 0 < told["error"] <= told["worst_error"] < 1e-3
    with shoal.Simulation(pairs(), diagnostics=False) as simulation, pytest.raises(shoal.Error, match="diagnostics=False"):
        simulation.diagnostics()


def test_set_state_is_what_is_read_back(hello):
    places = hello.positions() + [0.25, 1, -2]
    hello.set_state(positions=places, velocities=np.ones((20, 9, 3)))
    assert abs(hello.positions() - places).max() < 1e-6
    assert (hello.velocities() == 1).all()


def test_compute_shaders_that_fail_are_told(tmp_path):
    shutil.copytree(ROOT / "shaders", tmp_path / "shaders")
    for name in ("models", "molecules"):
        (tmp_path / name).symlink_to(ROOT / name)
    with open(tmp_path / "shaders/fused/lane.glsl", "a") as lane:
        lane.write("\n#ifndef LAYERED\nbroken;\n#endif\n")
    text = "import shoal; shoal.Simulation(shoal.Scene('hello')).step(1)"
    run = subprocess.run([sys.executable, "-c", text], env=dict(os.environ, SHOAL_DATA=str(tmp_path)), capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    assert "RuntimeWarning" in run.stderr and "going on in fragment shaders" in run.stderr


def test_a_run_is_repeated_and_resumed(hello, tmp_path):
    start = hello.hash()
    hello.step(10)
    hello.save(tmp_path / "state.shoal")
    hello.step(10)
    end = hello.hash()
    hello.load(tmp_path / "state.shoal")
    hello.step(10)
    assert hello.hash() == end
    hello.restart()
    assert hello.hash() == start


def test_parameters_act(hello):
    other = shoal.Simulation(shoal.Scene("hello"))
    other.parameters.gravity = [0, 0, 0]
    assert other.parameters.gravity == [0, 0, 0]
    for simulation in (hello, other):
        simulation.step(20)
    assert hello.positions()[..., 1].mean() < other.positions()[..., 1].mean() - 0.1
    other.close()


def test_parameters_that_need_more_substeps_get_them(recwarn):
    def frames(**parameters):
        with shoal.Simulation(pairs(), solver="leapfrog", substeps=2) as simulation:
            for name, value in parameters.items():
                setattr(simulation.parameters, name, value)
            taken = simulation.parameters.substeps
            simulation.step(5)
            return taken, simulation.positions()
    assert frames(stiffness=1)[0] == 2 and not recwarn
    with pytest.warns(RuntimeWarning, match="^stiffness: a frame takes [0-9]+ substeps, .* more than 2$"):
        needed, positions = frames(stiffness=1e4)
    assert 2 < needed < 1000 and np.isfinite(positions).all()
    with shoal.Simulation(pairs(), solver="leapfrog", substeps=2) as simulation:
        parameters = simulation.parameters
        with pytest.warns(RuntimeWarning):
            parameters.stiffness = 1e4
        with pytest.warns(RuntimeWarning, match=f"^substeps: a frame takes {needed} substeps, .* more than 3$"):
            parameters.substeps = 3
        assert parameters.substeps == needed
        parameters.stiffness = 1
        assert parameters.substeps == 3  # as was asked for
        with pytest.raises(shoal.Error, match="stiffness: a frame would need [0-9]+ substeps and has at most 1000"):
            parameters.stiffness = 1e12
        assert parameters.stiffness == 1 and parameters.substeps == 3


def test_fields_and_forces_have_factors():
    scene = pairs(
        gravity=[0, 0, 0],
        fields=[{"name": "breeze", "type": "uniform", "velocity": [1, 0, 0]}, {"type": "uniform", "velocity": [0, 0, 1]}],
        forces=[{"name": "draught", "type": "wind", "velocity": [0, 2, 0]}],
    )
    with shoal.Simulation(scene) as simulation:
        parameters = simulation.parameters
        forces, fields = parameters.forces, parameters.fields
        assert list(forces.items()) == [("draught", 1)] and forces[0] == forces["draught"] == 1
        forces["draught"] = 0
        fields[1] = 0
        assert dict(forces) == {"draught": 0} and fields.values() == [1, 0] and len(fields) == 2
        parameters.fields = [2, 3]
        parameters.fields = {"breeze": 0.5}
        assert fields.values() == [0.5, 3]
        for wrong, words in (
            (lambda: setattr(parameters, "forces", [1, 2]), "expected 1 factors, found 2"),
            (lambda: setattr(parameters, "fields", {1: 7, "breze": 1}), 'did you mean "breeze"'),
            (lambda: forces[1], "there is no number 1"),
            (lambda: forces.__setitem__("draught", np.inf), "forces is not finite"),
        ):
            with pytest.raises(shoal.Error, match=words):
                wrong()
        assert fields.values() == [0.5, 3]
        simulation.step()


def test_parameters_keep_the_simulation():
    parameters = shoal.Simulation(shoal.Scene("hello"), substeps=7).parameters
    fields = shoal.Simulation(shoal.Scene("hello")).parameters.fields
    gc.collect()
    assert parameters.substeps == 7 and parameters.wind == 1
    assert len(fields) == 1 and fields[np.int64(0)] == 1
    with pytest.raises(shoal.Error, match="expected a name or a number"):
        fields[1.5]


def test_fields_act_by_name():
    place = {"on": "list", "items": [{"position": [0, 0, 0]}]}
    scene = shoal.Scene(
        {
            "groups": [{"molecule": PAIR, "place": place, "drag": 2}],
            "gravity": [0, 0, 0],
            "fields": [{"name": "breeze", "type": "uniform", "velocity": [1, 0, 0]}],
        }
    )
    with shoal.Simulation(scene) as simulation:
        simulation.parameters.fields["breeze"] = 0
        simulation.step(20)
        assert np.abs(simulation.velocities()).max() < 1e-3
        simulation.parameters.fields["breeze"] = 2
        simulation.step(20)
        assert (simulation.velocities().mean(axis=1)[:, 0] > 0.1).all()


def test_pictures_are_arrays(hello):
    picture = hello.picture(160, 90)
    assert picture.shape == (90, 160, 4) and picture.dtype == np.uint8
    assert (picture[..., 3] == 255).all() and picture[..., :3].std() > 10
    near = hello.picture(160, 90, eye=[0, 1, 2], target=[0, 0.5, 0])
    assert abs(near.astype(int) - picture).mean() > 5


def test_pictures_are_written_and_shown(hello, tmp_path):
    picture = hello.picture(160, 90)
    assert isinstance(picture, np.ndarray) and isinstance(picture, shoal.Picture)
    picture.save(tmp_path / "a.png")
    png = (tmp_path / "a.png").read_bytes()
    assert png.startswith(b"\x89PNG") and picture._repr_png_() == png
    assert int.from_bytes(png[16:20], "big") == 160 and int.from_bytes(png[20:24], "big") == 90
    picture[:45, ::2].save(str(tmp_path / "half.png"))
    half = (tmp_path / "half.png").read_bytes()
    assert int.from_bytes(half[16:20], "big") == 80 and int.from_bytes(half[20:24], "big") == 45
    for other in (picture / 2, picture[0], picture[:0]):
        assert other._repr_png_() is None
        with pytest.raises(shoal.Error, match="only an array of shape .height, width, 1 to 4. of uint8"):
            other.save(tmp_path / "none.png")
    with pytest.raises(shoal.Error, match="cannot make this folder"):
        picture.save(tmp_path / "a.png/b.png")
    assert hello._repr_png_().startswith(b"\x89PNG")
    hello.close()
    assert hello._repr_png_() is None


def test_molecules_are_made_in_code(tmp_path):
    molecule = shoal.Molecule(PAIR)
    assert molecule.name == "pair" and molecule.springs == 1 and molecule.vertices.tolist() == [[0, 0, 0], [1, 0, 0]]
    molecule.save(tmp_path / "pair.json")
    assert shoal.Molecule(tmp_path / "pair.json").vertices.shape == (2, 3)
    scene = shoal.Scene({"groups": [{"molecule": molecule, "place": {"on": "list", "items": [{"position": [0, 0, 0]}]}}]})
    assert scene.groups == ["pair"]


def test_errors_say_where(tmp_path, hello):
    with pytest.raises(shoal.Error, match="no such file: nope.json") as caught:
        shoal.Scene({"groups": [{"molecule": "nope.json"}]})
    assert caught.value.path == "$.groups[0].molecule" and caught.value.line == 1
    bad = tmp_path / "bad.scene.json"
    bad.write_text('{\n "format": "shoal-scene-1",\n "grups": []\n}')
    with pytest.raises(shoal.Error) as caught:
        shoal.Scene(bad)
    assert caught.value.file == str(bad) and caught.value.line == 3
    for wrong, words in (
        (lambda: hello.positions("leafs"), 'did you mean "leaf"'),
        (lambda: hello.positions(1), "there is no group 1"),
        (lambda: hello.step(-1), "0 frames or more"),
        (lambda: hello.set_state(positions=np.zeros((3, 4, 3))), r"expected an array of shape \(20, 9, 3\), found \(3, 4, 3\)"),
        (lambda: hello.set_state(velocities=np.full((20, 9, 3), np.nan)), "not finite"),
        (lambda: hello.picture(0, 10), "pixels a side"),
        (lambda: shoal.Simulation(shoal.Scene("hello"), solver="leapfog"), 'did you mean "leapfrog"'),
        (lambda: shoal.Simulation(shoal.Scene("hello"), device=99), "no device 99"),
        (lambda: hello.load(tmp_path / "none.shoal"), "none.shoal"),
        (lambda: hello.picture(eye=[np.nan, 0, 0]), "eye is not finite"),
        (lambda: hello.picture(target=[0, np.inf, 0]), "target is not finite"),
        (lambda: hello.picture(field_of_view=4), "between 0 and pi"),
        (lambda: shoal.measure(shoal.Scene("hello"), duration=np.nan), "duration is not finite"),
        (lambda: shoal.measure(shoal.Scene("hello"), seconds=0), "seconds is above 0"),
        (lambda: setattr(hello.parameters, "wind", np.nan), "wind is not finite"),
        (lambda: setattr(hello.parameters, "gravity", [0, np.nan, 0]), "gravity is not finite"),
        (lambda: setattr(hello.parameters, "substeps", 0), "1 to 1000 substeps"),
        (lambda: setattr(hello.parameters, "drag", -1), "drag is at least 0"),
        (lambda: hello.set_state(positions=np.full((20, 9, 3), 1e300)), "beyond what a float holds"),
        (lambda: hello.positions(1.0), "a name, a number or None"),
        (lambda: shoal.Scene(3), "a scene is a file, a name or a dict, found 3"),
        (lambda: shoal.Molecule(None), "a molecule is a file or a dict, found None"),
        (lambda: setattr(hello.parameters, "frame_time", 0), "frame_time is from 1e-5 to 1 s"),
    ):
        with pytest.raises(shoal.Error, match=words):
            wrong()
    with pytest.raises(TypeError):
        hello.step("many")


def test_a_closed_simulation_says_so():
    simulation = shoal.Simulation(shoal.Scene("hello"))
    simulation.close()
    simulation.close()
    with pytest.raises(shoal.Error, match="was closed"):
        simulation.step()


def test_another_thread_is_refused(hello):
    caught = []

    def work():
        try:
            hello.step()
        except shoal.Error as error:
            caught.append(str(error))

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert caught and "another thread" in caught[0]


def test_the_interpreter_goes_on_while_a_simulation_steps(hello):
    ticks, done = [0], threading.Event()

    def count():
        while not done.is_set():
            ticks[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = ticks[0]
    hello.step(300)
    during = ticks[0] - before
    done.set()
    thread.join()
    assert during > 1000


def test_arrays_and_numbers_of_numpy_stand_for_lists_and_numbers():
    gravity, mass = np.array([0, -5.0, 0]), np.float32(0.25)
    light = {**PAIR, "vertices": [{"position": np.zeros(3), "mass": mass}, {"position": [1, 0, 0], "mass": np.int64(1)}]}
    scene = {"groups": [{"molecule": light, "place": {"on": "list", "items": [{"position": gravity}]}}], "gravity": gravity}
    with shoal.Simulation(shoal.Scene(scene)) as simulation:
        assert list(simulation.parameters.gravity) == [0, -5, 0]
    with pytest.raises(shoal.Error, match=r"found \{1, 2\}"):
        shoal.Scene({"groups": {1, 2}})


def test_an_interrupt_ends_a_long_call(hello):
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        hello.step(10**9)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        shoal.measure(shoal.Scene("hello"), duration=20)


def test_an_interrupt_ends_the_baking_of_a_field(monkeypatch, tmp_path):
    monkeypatch.setenv("SHOAL_CACHE", str(tmp_path))
    model = {"file": str(ROOT / "models/tree/tree.obj"), "name": "tree"}
    field = {"type": "distanceField", "model": "tree", "resolution": 280, "name": "field"}
    threading.Timer(1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        pairs(models=[model], colliders=[field])
    assert not [file for file in tmp_path.rglob("*") if file.is_file()]  # it did not come to its end


def test_what_has_run_away_is_not_saved(tmp_path):
    with shoal.Simulation(pairs()) as simulation:
        simulation.set_state(0, velocities=np.full((1, 2, 3), 1e6))
        with pytest.raises(shoal.Error, match="stopped at"):
            simulation.step()
        with pytest.raises(shoal.Error, match="stopped at"):
            simulation.save(tmp_path / "a.shoal")
        assert not (tmp_path / "a.shoal").exists()


def test_check_and_measure():
    assert shoal.check(ROOT / "molecules/leaf.json") == []
    assert any("without any stiffness" in finding.message for finding in shoal.check(ROOT / "tests/cli/squares.scene.json"))
    missing = shoal.check("none.json")
    assert len(missing) == 1 and missing[0].error
    squares = shoal.Scene(ROOT / "tests/cli/squares.scene.json")
    rows = shoal.measure(squares, duration=0.1, solvers=["leapfrog"])
    assert {row["solver"] for row in rows} == {"leapfrog"}
    assert 0 < min(row["error"] for row in rows if row["error"] is not None) < 1e-5
    for words, message in ((["frog"], 'unknown solver "frog"'), (["auto"], "solvers: expected the names")):
        with pytest.raises(shoal.Error, match=message):
            shoal.measure(squares, solvers=words)


def test_stubs_name_what_the_module_has():
    stub = ast.parse((ROOT / "src/python/shoal.pyi").read_text())
    for node in stub.body:
        if isinstance(node, ast.FunctionDef):
            assert hasattr(shoal, node.name)
        if not isinstance(node, ast.ClassDef):
            continue
        has = getattr(shoal, node.name)
        named = {item.name for item in node.body if isinstance(item, ast.FunctionDef)}
        named |= {item.target.id for item in node.body if isinstance(item, ast.AnnAssign)}
        if node.name != "Error":  # whose members are those of an instance
            public = {name for name in set(dir(has)) - set(dir(has.__base__)) if not name.startswith("_")}
            assert public == {name for name in named if not name.startswith("_")}, node.name
            for name in public:
                assert getattr(has, name).__doc__, (node.name, name)
        for item in node.body:
            if isinstance(item, ast.FunctionDef) and not item.decorator_list and not item.name.startswith("_"):
                assert names_of(getattr(has, item.name)) == [a.arg for a in item.args.args + item.args.kwonlyargs]


def names_of(function):
    return list(inspect.signature(function).parameters)


def test_help_names_arguments_and_units():
    simulation = shoal.Simulation
    assert names_of(simulation) == ["scene", "solver", "substeps", "device", "path", "diagnostics"]
    assert str(inspect.signature(simulation.step)) == "(self, frames=1)"
    assert str(inspect.signature(simulation.set_state)) == "(self, group=None, *, positions=None, velocities=None)"
    assert names_of(shoal.measure) == ["scene", "duration", "solvers", "seconds", "device"]
    shown = pydoc.render_doc(simulation.picture, renderer=pydoc.plaintext)
    # newer Pythons break long lines
    assert "picture(self,width=640,height=360,*,eye=None,target=None,field_of_view=None" in "".join(shown.split())
    for member, unit in (
        (simulation.positions, " m,"),
        (simulation.velocities, " m/s,"),
        (simulation.energy, " J "),
        (simulation.time, " s."),
        (shoal.Parameters.gravity, " m/s^2"),
        (shoal.Parameters.frame_time, " s."),
        (shoal.Molecule.vertices, " m,"),
    ):
        assert unit in member.__doc__


@pytest.mark.parametrize("script", ["sweep", "ribbon", "resets"])
def test_examples_run(script, tmp_path):
    pytest.importorskip("matplotlib")
    (tmp_path / "molecules").symlink_to(ROOT / "molecules")
    run = subprocess.run([sys.executable, ROOT / f"docs/python/{script}.py"], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    if script == "resets":
        assert float(run.stdout.split("misses by ")[1].split()[0]) < 0.05
    else:
        assert (tmp_path / f"{script}.png").stat().st_size > 10000


def in_another_process(text):
    """What `text` prints there: a crash or a wait is a failure of this test alone."""
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, (done.returncode, done.stderr)
    return done.stdout


# Every way to use an object of a class: its methods with up to three arguments, its properties read and set.
USES = """
import inspect, shoal
VALUES = (None, 0, "a", 1e400, object(), "\\udc80", 1 << 70, {"a": "b"}, [1, 2])
classes = [c for c in vars(shoal).values() if type(c).__name__ == "pybind11_type"]
assert len(classes) == 6
def uses(c, make):
    for name, member in vars(c).items():
        if name in ("__init__", "__new__") or not (callable(member) or isinstance(member, property)):
            continue
        if isinstance(member, property):
            yield name, lambda: getattr(make(), name)
            for value in VALUES:
                yield name, lambda: setattr(make(), name, value)
            continue
        for count in range(4):
            for value in VALUES if count else VALUES[:1]:
                yield name, lambda: getattr(make(), name)(*[value] * count)
"""


def test_what_was_made_without_its_constructor_raises():
    out = in_another_process(USES + """
import copy
told = set()
for c in classes:
    for name, use in uses(c, lambda: c.__new__(c)):
        try:
            use()
        except (shoal.Error, TypeError, AttributeError) as error:
            if "without its constructor" in str(error):
                told.add((c, name))
        else:
            raise SystemExit(f"{c.__name__}.{name} did not raise")
    for name, member in vars(c).items():
        ours = name not in ("__init__", "__new__", "_pybind11_conduit_v1_")
        if isinstance(member, property) or callable(member) and ours:
            assert (c, name) in told, (c, name)
for use in (lambda: shoal.Simulation(shoal.Scene.__new__(shoal.Scene)), lambda: shoal.measure(shoal.Scene.__new__(shoal.Scene)),
            lambda: shoal.Scene({"groups": [{"molecule": shoal.Molecule.__new__(shoal.Molecule)}]})):
    try:
        use()
    except shoal.Error as error:
        print("without its constructor" in str(error))
""")
    assert out.split() == ["True"] * 3


def test_arguments_that_do_not_fit_are_told_in_our_words():
    in_another_process(USES + f"""
import os, tempfile
os.chdir(tempfile.mkdtemp())
simulation = shoal.Simulation(shoal.Scene("hello"))
made = [shoal.Molecule(f"{ROOT}/molecules/leaf.json"), simulation.parameters, simulation.parameters.fields, shoal.Scene("hello"),
        shoal.check("none.json")[0], simulation]
assert sorted(type(x).__name__ for x in made) == sorted(c.__name__ for c in classes)
def holds(use):
    try:
        use()
    except Exception as error:
        text = str(error)
        for word in ("PYBIND11", "incompatible", "Unable to cast", "Invoked with", "numpy.ndarray[", "arg0", "self:"):
            assert word not in text, text
for x in made:
    for name, use in uses(type(x), lambda: x):
        if (type(x), name) not in ((shoal.Simulation, "close"), (shoal.Simulation, "__exit__")):
            holds(use)
for f in (shoal.check, shoal.measure, shoal.Scene, shoal.Molecule, shoal.Simulation):
    for value in VALUES:
        for count in range(4):
            if value != 0:  # the standard input as a file
                holds(lambda: f(*[value] * count))
                holds(lambda: f(nothing=value))
                holds(lambda: f(shoal.Scene("hello"), duration="a", substeps=value))
""")
    with shoal.Simulation(shoal.Scene("hello")) as simulation:
        with pytest.raises(TypeError, match=r"^Simulation.step: expected \(frames: int = 1\), found \('x'\)$"):
            simulation.step("x")
        with pytest.raises(TypeError, match=r"^Parameters.wind: expected \(float\), found \('x'\)$"):
            simulation.parameters.wind = "x"
        with pytest.raises(TypeError, match=r"^fields: expected a number, found 'x'$"):
            simulation.parameters.fields = ["x"]
    with pytest.raises(TypeError, match=r"^Simulation.__init__: expected \(scene: Scene, \*, .*found \(None\)$"):
        shoal.Simulation(None)


def test_a_forked_process_is_refused(hello):
    hello.step()
    child = os.fork()
    if child == 0:
        told = 0
        for use in (hello.step, hello.positions, hello.hash, hello.picture, hello.restart, lambda: shoal.Simulation(shoal.Scene("hello"))):
            try:
                use()
            except shoal.Error as error:
                told += "forked" in str(error)
        os._exit(told)
    for _ in range(200):
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            break
        time.sleep(0.1)
    else:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        pytest.fail("the child waits for ever")
    assert os.waitstatus_to_exitcode(status) == 6
    hello.step()


def test_a_device_goes_on_when_its_thread_has_ended():
    out = in_another_process("""
import threading, shoal
kept = []
def work():
    kept.append(shoal.Simulation(shoal.Scene("hello")))
    kept[0].step(3)
raised = []
def other_thread():
    try:
        kept[0].step(1)
    except shoal.Error as error:
        raised.append("another thread" in str(error))
for target in (work, other_thread):
    thread = threading.Thread(target=target)
    thread.start()
    thread.join()
    if target is work:
        other = shoal.Simulation(shoal.Scene("hello"))
        other.step(5)
        kept[0].step(2)
        print(kept[0].hash() == other.hash(), (kept[0].picture(8, 8) == other.picture(8, 8)).all())
print(raised)
""")
    assert out.split() == ["True", "True", "[True]"]
