"""Numbers that decide an outcome of the diagnosis, each with the kind of its reason.

Definition: follows from the meaning of the name. Source: from the literature. Measured: by the named test. Grid: tried
values; the readings choose among them. Cost limit: more would cost time and change answers little. Judgement: chosen by
the authors; a similar value would be as defensible.
"""
