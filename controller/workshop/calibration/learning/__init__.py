"""A measurement folder to learned responses: where its points lie, what its sensor does, what is wrong with it."""
