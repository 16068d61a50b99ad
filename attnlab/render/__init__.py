"""An episode of a run as a film."""
