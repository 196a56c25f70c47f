"""One function of many items: in this process, in processes of this machine, or on the workers of a dask scheduler."""
