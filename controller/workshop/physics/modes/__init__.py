"""Resonances of a plate: closed form and Ritz."""
