from .layouts import Dataset as Dataset
from .layouts import DatasetError as DatasetError
from .layouts import DatasetItem as DatasetItem
from .layouts import open_dataset as open_dataset
