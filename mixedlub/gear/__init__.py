"""Gears: from the data sheet to the contact points of a tooth pair and their loads."""

from mixedlub.gear.distribution import LdpSharing, LoadDistribution, transmission_error
from mixedlub.gear.geometry import GearPair
from mixedlub.gear.iso_stiffness import IsoStiffness, iso_stiffness
from mixedlub.gear.loss_factors import LossFactor, local_loss_factor, loss_factors
from mixedlub.gear.mesh import ROUNDED, Mesh, Sharing, at_roll_angle, mesh
from mixedlub.gear.sharing.rigid import RigidSharing
from mixedlub.gear.sharing.table import TableSharing

__all__ = [
    "ROUNDED",
    "GearPair",
    "IsoStiffness",
    "LdpSharing",
    "LoadDistribution",
    "LossFactor",
    "Mesh",
    "RigidSharing",
    "Sharing",
    "TableSharing",
    "at_roll_angle",
    "iso_stiffness",
    "local_loss_factor",
    "loss_factors",
    "mesh",
    "transmission_error",
]
