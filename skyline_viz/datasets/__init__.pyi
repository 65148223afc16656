from .dataset import Dataset as Dataset
from .dataset import DatasetError as DatasetError
from .dataset import DatasetItem as DatasetItem
from .layouts import open_dataset as open_dataset
