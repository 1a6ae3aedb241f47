"""The guard of the page: this machine alone, its own origin alone, uploads of limited size."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

LARGEST_UPLOAD = 50 * 2**20
"""Judgement. Largest size of the files sent at once (bytes): an hour of three channels at 500 readings a second."""
ENVELOPE = 2**16
"""Judgement. Room for the names and borders of the parts of an upload (bytes)."""
READING = ("GET", "HEAD")
TOO_LARGE = f"The files are larger than {LARGEST_UPLOAD // 2**20} MB together; send fewer, or average them first."
PAGE = (
    "default-src 'none'; img-src 'self' data:; style-src 'self'; script-src 'self'; connect-src 'self'; "
    "frame-src 'self'; form-action 'self'; base-uri 'none'; frame-ancestors 'none'"
)
"""Content policy of the pages: nothing but this server."""
RESULT = (
    "default-src 'none'; img-src 'self' data:; style-src 'unsafe-inline'; script-src 'unsafe-inline' 'unsafe-eval'; "
    "font-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'self'; sandbox allow-scripts allow-downloads"
)
"""Content policy of a written page: its own scripts in a sandbox that reaches neither the network nor the app."""
HEADERS = {
    "x-content-type-options": "nosniff",
    "referrer-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-opener-policy": "same-origin",
    "cache-control": "no-store",
}


class Guard:
    """Middleware that answers foreign hosts, foreign origins and large uploads with one sentence."""

    def __init__(self, app: ASGIApp, hosts: Collection[str]) -> None:
        self.app, self.hosts = app, frozenset(hosts)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            if scope["type"] == "lifespan":
                await self.app(scope, receive, send)
            return
        headers = {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}
        refusal = self.refused(scope["method"], headers)
        if refusal:
            await _say(*refusal, receive, send)
            return
        over = False
        started = False
        received = 0

        async def counted() -> Message:
            nonlocal received, over
            message = await receive()
            received += len(message.get("body", b""))
            if received > LARGEST_UPLOAD + ENVELOPE:
                over = True
                await _drained(receive, message)
                return {"type": "http.disconnect"}
            return message

        async def headed(message: Message) -> None:
            nonlocal started
            if over:
                return
            if message["type"] == "http.response.start":
                started = True
                present = {name.lower() for name, _ in message["headers"]}
                own = {**HEADERS, "content-security-policy": PAGE}
                message["headers"] = [
                    *message["headers"],
                    *((k.encode(), v.encode()) for k, v in own.items() if k.encode() not in present),
                ]
            await send(message)

        try:
            await self.app(scope, counted, headed)
        except Exception:
            if not over:
                raise
        if over and not started:
            await _say(413, TOO_LARGE, receive, send, drain=False)

    def refused(self, method: str, headers: dict[str, str]) -> tuple[int, str] | None:
        """Status and sentence of a refusal; None for a request that may pass."""
        if headers.get("host", "") not in self.hosts:
            return 403, "This page answers to 127.0.0.1 and localhost alone."
        origin = headers.get("origin")
        if origin is not None and origin.removeprefix("http://") not in self.hosts:
            return 403, "A page of another origin may not use this one."
        if method not in READING and headers.get("sec-fetch-site", "none") not in ("same-origin", "none"):
            return 403, "A page of another origin may not use this one."
        length = headers.get("content-length", "0")
        if not length.isdecimal() or int(length) > LARGEST_UPLOAD + ENVELOPE:
            return 413, TOO_LARGE
        return None


async def _drained(receive: Receive, message: Message) -> None:
    """Read the rest of a request, which a browser sends before it looks at the answer."""
    while message["type"] == "http.request" and message.get("more_body", False):
        message = await receive()


async def _say(status: int, sentence: str, receive: Receive, send: Send, *, drain: bool = True) -> None:
    if drain:
        await _drained(receive, {"type": "http.request", "more_body": True})
    body = sentence.encode()
    plain = [(b"content-type", b"text/plain; charset=utf-8"), (b"content-length", str(len(body)).encode())]
    own = [(name.encode(), value.encode()) for name, value in HEADERS.items()]
    await send({"type": "http.response.start", "status": status, "headers": [*plain, *own]})
    await send({"type": "http.response.body", "body": body})
