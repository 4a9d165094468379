# SPDX-License-Identifier: GPL-3.0-or-later
"""JSON-RPC 2.0 over two streams, as fbd-mcp and fbd-lsp speak it: requests, notifications, errors."""
from __future__ import annotations

import json
import math
import sys
from typing import Any, BinaryIO, Callable, Dict, Optional

PARSE_ERROR = -32700
INVALID_REQUEST = -32600
METHOD_NOT_FOUND = -32601
INVALID_PARAMS = -32602
INTERNAL_ERROR = -32603

Json = Dict[str, Any]


class RpcError(Exception):
    """A request that is answered by an error."""

    def __init__(self, code: int, message: str, data: Any = None):
        super().__init__(message)
        self.code, self.message, self.data = code, message, data

    def json(self) -> Json:
        return {"code": self.code, "message": self.message, **({} if self.data is None else {"data": self.data})}


def plain(value: Any) -> Any:
    """The value with null for numbers that JSON does not have."""
    if isinstance(value, dict):
        return {key: plain(each) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def coded(message: Any) -> bytes:
    """One line of JSON in UTF-8; a surrogate that stands alone stays an escape."""
    text = json.dumps(plain(message), ensure_ascii=False, allow_nan=False)
    try:
        return text.encode("utf-8")
    except UnicodeEncodeError:
        return json.dumps(plain(message), allow_nan=False).encode("ascii")


# ---- how messages are cut from a stream


def read_line(stream: BinaryIO) -> Optional[bytes]:
    """The next line that is not empty; None at the end."""
    for line in iter(stream.readline, b""):
        if line.strip():
            return line
    return None


def write_line(stream: BinaryIO, body: bytes) -> None:
    stream.write(body + b"\n")
    stream.flush()


def read_framed(stream: BinaryIO) -> Optional[bytes]:
    """The body behind a header with its length; None at the end."""
    length = None
    for line in iter(stream.readline, b""):
        name, _, value = line.decode("ascii", "replace").partition(":")
        if name.strip().lower() == "content-length" and value.strip().isdigit():
            length = int(value)
        if not line.strip() and length is not None:
            body = stream.read(length)
            return body if len(body) == length else None
    return None


def write_framed(stream: BinaryIO, body: bytes) -> None:
    stream.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
    stream.flush()


# ---- serving

Method = Callable[[Json], Any]


class Server:
    """Answers requests by ``methods``, one after the other."""

    read: Callable[[BinaryIO], Optional[bytes]] = staticmethod(read_line)
    write: Callable[[BinaryIO, bytes], None] = staticmethod(write_line)

    def __init__(self, source: BinaryIO, sink: BinaryIO):
        self.source, self.sink = source, sink
        self.methods: Dict[str, Method] = {}
        self.going = True

    def send(self, message: Json) -> None:
        type(self).write(self.sink, coded({"jsonrpc": "2.0", **message}))

    def notify(self, method: str, params: Json) -> None:
        self.send({"method": method, "params": params})

    def call(self, method: str, params: Json) -> Any:
        function = self.methods.get(method)
        if function is None:
            raise RpcError(METHOD_NOT_FOUND, f"there is no method `{method}`")
        return function(params)

    def answer(self, message: Any) -> Optional[Json]:
        """The response to a message; None for a notification, or a response to a request that is not ours."""
        if not isinstance(message, dict) or message.get("jsonrpc") != "2.0":
            return {"id": None, "error": RpcError(INVALID_REQUEST, "no JSON-RPC 2.0 message").json()}
        asked = "id" in message
        if "method" not in message and ("result" in message or "error" in message):
            return None
        try:
            method, params = message.get("method"), message.get("params", {})
            if not isinstance(method, str):
                raise RpcError(INVALID_REQUEST, "the method must be a text")
            if not isinstance(params, dict):
                raise RpcError(INVALID_PARAMS, "params must be an object")
            response: Json = {"result": self.call(method, params)}
        except RpcError as error:
            response = {"error": error.json()}
        except (BrokenPipeError, KeyboardInterrupt):
            raise
        except Exception as error:  # pylint: disable=broad-exception-caught # a server goes on
            print(f"{type(error).__name__}: {error}", file=sys.stderr)
            response = {"error": RpcError(INTERNAL_ERROR, f"{type(error).__name__}: {error}").json()}
        return {"id": message["id"], **response} if asked else None

    def serve(self) -> None:
        """Until the stream ends, or a method ends it."""
        while self.going:
            body = type(self).read(self.source)
            if body is None:
                return
            try:
                message = json.loads(body)
            except (ValueError, RecursionError) as error:
                self.send({"id": None, "error": RpcError(PARSE_ERROR, f"no JSON: {error}").json()})
                continue
            response = self.answer(message)
            if response is not None:
                self.send(response)
