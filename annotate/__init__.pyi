from .engine.live_wire import LiveWire as LiveWire
from .store.labels import Label as Label
