"""A load-sharing model."""

from dataclasses import dataclass
from typing import Annotated

from mixedlub.gear import RigidSharing
from mixedlub.gear.sharing.model import SharingModel
from mixedlub.schema.ranges import Range
from mixedlub.schema.section import Number, Section, key


class Keys(Section):
    lost_share: Annotated[Number, Range("gears.load_sharing.lost_share", (0.0, 1.0), (0.0, 0.2))] = key(
        'model "lossy": share of the load that no tooth carries', 0.1
    )


@dataclass(frozen=True)
class LossySharing(RigidSharing):
    lost: float = 0.0

    def load_share(self, mesh, torque):
        return (1.0 - self.lost) * super().load_share(mesh, torque)


MODEL = SharingModel(
    name="lossy",
    meaning="rigid teeth that lose a part of the load",
    build=lambda section, folder: LossySharing(section.lost_share),
    keys=Keys,
)
