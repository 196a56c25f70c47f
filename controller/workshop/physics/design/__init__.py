"""A panel's figures by the equations of the paper."""
