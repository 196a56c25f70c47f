"""haptic-panel: the controller of a glass panel that pushes back under each finger."""

__version__ = "0.1.0"
