from .batch import Failure as Failure
from .batch import run as run
from .progress import ProgressBar as ProgressBar
from .resume import Codec as Codec
from .resume import Kept as Kept
from .warming import warm_up as warm_up
