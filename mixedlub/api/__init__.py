"""The Python face: what `import mixedlub as ml` offers to notebooks."""
