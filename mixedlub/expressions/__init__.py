"""Expressions of laws as text: arithmetic, powers and a few functions over named quantities."""

from mixedlub.expressions.parsing import parse
from mixedlub.expressions.tree import FUNCTIONS, Call, Expression, Name, Node, Number

__all__ = ["FUNCTIONS", "Call", "Expression", "Name", "Node", "Number", "parse"]
