"""Tables of labels in Parquet, as data sets."""
