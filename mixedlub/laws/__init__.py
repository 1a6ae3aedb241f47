"""The base laws: each one pure function of arrays in SI; ``laws.film.dowson_toyoda`` needs no further import."""

from pkgutil import iter_modules

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach(__name__, [module.name for module in iter_modules(__path__)])
