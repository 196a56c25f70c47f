"""The push-pull stage: power and pictures."""
