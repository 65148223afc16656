"""Working on a cluster of many machines, by way of dask.distributed."""
