"""Home of drop-in parts: the plugins/ folders are appended to this package's path, so that every worker process can
import them by name (see :func:`attnlab.loading.load_all`)."""
