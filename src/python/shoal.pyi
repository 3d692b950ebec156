"""Very many small mass-spring meshes, simulated and drawn on the GPU.

SI units. Arrays have the shape (molecules, vertices, 3). A group is given by name or number, or left out where the scene
has one.
"""
from os import PathLike
from typing import Any, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Group = str | int | None
File = str | PathLike[str]

class Error(RuntimeError):
    message: str
    file: str | None
    line: int | None
    path: str | None

class Molecule:
    def __init__(self, source: File | dict[str, Any]) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def vertices(self) -> NDArray[np.float64]: ...
    @property
    def springs(self) -> int: ...
    def save(self, file: File) -> None: ...

class Scene:
    def __init__(self, source: File | dict[str, Any], folder: File = ".") -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def groups(self) -> list[str]: ...

class Parameters:
    wind: float
    drag: float
    stiffness: float
    damping: float
    substeps: int
    frame_time: float
    gravity: Sequence[float]
    fields: list[float]
    forces: list[float]

class Simulation:
    def __init__(
        self,
        scene: Scene,
        *,
        solver: str | None = None,
        substeps: int | None = None,
        device: int | None = None,
        path: str = "auto",
    ) -> None: ...
    def step(self, frames: int = 1) -> None: ...
    def restart(self) -> None: ...
    def close(self) -> None: ...
    def __enter__(self) -> Simulation: ...
    def __exit__(self, *args: Any) -> None: ...
    @property
    def time(self) -> float: ...
    @property
    def frames(self) -> int: ...
    @property
    def groups(self) -> list[str]: ...
    @property
    def parameters(self) -> Parameters: ...
    def solver(self, group: Group = None) -> str: ...
    def positions(self, group: Group = None) -> NDArray[np.float64]: ...
    def velocities(self, group: Group = None) -> NDArray[np.float64]: ...
    def normals(self, group: Group = None) -> NDArray[np.float32]: ...
    def alive(self, group: Group = None) -> NDArray[np.bool_]: ...
    def set_state(
        self, group: Group = None, *, positions: ArrayLike | None = None, velocities: ArrayLike | None = None
    ) -> None: ...
    def energy(self, group: Group = None) -> dict[str, float]: ...
    def picture(
        self,
        width: int = 640,
        height: int = 360,
        *,
        eye: Sequence[float] | None = None,
        target: Sequence[float] | None = None,
        field_of_view: float | None = None,
    ) -> NDArray[np.uint8]: ...
    def hash(self) -> str: ...
    def save(self, file: File) -> None: ...
    def load(self, file: File) -> None: ...

class Finding:
    file: str
    line: int
    path: str
    message: str
    error: bool

def check(file: File) -> list[Finding]: ...
def measure(
    scene: Scene, *, duration: float = 1.0, seconds: float | None = None, device: int | None = None
) -> list[dict[str, Any]]: ...
