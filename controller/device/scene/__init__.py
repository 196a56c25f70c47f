"""What a finger feels: shapes, effects, trains and spacings; touch samples, time and commands in, emissions out."""
