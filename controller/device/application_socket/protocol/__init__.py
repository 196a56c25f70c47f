"""The protocol for programs in other languages: its JSON Schema, made from the records."""
