"""Photos by their addresses: in object storage, on web servers, in archives."""
