"""Where releases are made and signed: keys, drafts, repositories, wheels."""
