"""The command line: arguments, Hydra, errors that say what to do."""
