"""Clients' connections: the socket's file, who is at the other end and what its user may do, places, buffers."""
