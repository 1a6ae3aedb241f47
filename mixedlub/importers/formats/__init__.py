"""Binary measurement files, one module a format: ``matches`` the bytes, and ``tables`` with headers and units.

Other packages add modules as entry points of the group ``mixedlub.importers.formats``.
"""
