"""What makes the figures of README.md in this folder; each module names its figures and its command."""
