"""Line contacts solved in full by the generator's own code: heat, flow of any rheology, and elastic bodies.

Finite volumes with cavitation by a penalty, a parabolic temperature across the film, and walls by moving sources: other
equations and another method than the solver of the package, which is not imported.
"""
