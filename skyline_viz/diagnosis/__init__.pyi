from .causes import CAUSES as CAUSES
from .causes import Cause as Cause
from .diagnosing import Diagnosis as Diagnosis
from .diagnosing import diagnose as diagnose
