"""What the README's figures come from, a module each; ``python -m benchmarks [DATA]`` runs all."""
