from .registry import NAMES as NAMES
from .registry import Trained as Trained
from .registry import find_method as find_method
from .registry import learned_from as learned_from
from .registry import make_method as make_method
from .registry import save_method as save_method
