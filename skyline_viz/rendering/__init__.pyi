from .kinds import KINDS as KINDS
from .kinds import Kind as Kind
from .scenes import SAMPLES as SAMPLES
from .scenes import CameraChoice as CameraChoice
from .scenes import Scene as Scene
from .scenes import render as render
from .scenes import sample_scenes as sample_scenes
from .scenes import write_scenes as write_scenes
