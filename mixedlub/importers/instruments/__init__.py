"""Text files of instruments, one module a form: ``matches`` the text, and ``draft`` of a case from it.

Other packages add modules as entry points of the group ``mixedlub.importers``.
"""
