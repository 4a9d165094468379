# SPDX-License-Identifier: GPL-3.0-or-later
"""An importer of FMUs, FMI 3.0 and 2.0, by ctypes: what the tests drive FMUs with.

`Fmu` is an unpacked FMU with its description, `fmu.start(...)` an instance. Instances of both versions have the same
methods; each answers the status of the standard where nothing else is asked for."""
import ctypes as c
import os
import re
import subprocess
import xml.etree.ElementTree as ElementTree
import zipfile

OK, WARNING, DISCARD, ERROR = range(4)
RUN = os.environ["FBD_RUN"]


def make_fmu(model, path, *arguments):
    """Let fbd-run make an FMU of a model file."""
    subprocess.run([RUN, "--fmu", path, *map(str, arguments), str(model)], check=True)
    return path


class Variable:
    def __init__(self, element, attributes):
        self.name = element.get("name")
        self.reference = int(element.get("valueReference"))
        self.causality = element.get("causality")
        self.variability = element.get("variability")
        self.initial = element.get("initial")
        self.unit = attributes.get("unit", "")
        self.display = attributes.get("displayUnit", "")
        self.start = attributes.get("start")
        self.derivative = attributes.get("derivative")
        self.description = element.get("description", "")


class Fmu:
    def __init__(self, path, folder, load=True):
        with zipfile.ZipFile(path) as archive:
            assert archive.testzip() is None
            self.names = archive.namelist()
            archive.extractall(folder)
        self.folder = str(folder)
        self.xml = ElementTree.parse(os.path.join(self.folder, "modelDescription.xml")).getroot()
        self.version = int(self.xml.get("fmiVersion")[0])
        self.co_simulation = self.xml.find("CoSimulation")
        self.has_derivatives = any("irectionalDerivative" in key for key in self.co_simulation.attrib)
        self.identifier = self.co_simulation.get("modelIdentifier")
        self.token = self.xml.get("instantiationToken") or self.xml.get("guid")
        self.variables = {}
        for element in self.xml.find("ModelVariables"):
            attributes = element if self.version == 3 else element.find("Real")
            self.variables[element.get("name")] = Variable(element, attributes.attrib)
        self.outputs = [v.name for v in self.variables.values() if v.causality == "output"]
        self.inputs = [v.name for v in self.variables.values() if v.causality == "input"]
        self.parameters = [v.name for v in self.variables.values() if v.causality == "parameter"]
        place = "x86_64-linux" if self.version == 3 else "linux64"
        if self.version == 3:
            machine = os.uname().machine
            place = f"{machine}-linux"
        self.binary = os.path.join(self.folder, "binaries", place, self.identifier + ".so")
        self.resources = os.path.join(self.folder, "resources") + "/"
        if load:
            self.load()

    def load(self):
        self.library = c.CDLL(self.binary)

    def references(self, names):
        return (c.c_uint32 * len(names))(*[self.variables[name].reference for name in names])

    def start(self, exchange=False, **arguments):
        if exchange:
            arguments |= {"function": "InstantiateModelExchange"} if self.version == 3 else {"kind": 0}
        return (Instance3 if self.version == 3 else Instance2)(self, **arguments)

    def open(self, parameters=None, tolerance=None, start=0.0, stop=None, **arguments):
        """An instance past its initialization."""
        instance = self.start(**arguments)
        assert instance.pointer, instance.messages
        if parameters:
            assert instance.set(parameters) == OK, instance.messages
        assert instance.initialize(tolerance, start, stop) == OK, instance.messages
        assert instance.begin() == OK, instance.messages
        return instance


class Instance:
    """What both versions have in common; `p` is the prefix of their functions."""

    def __init__(self, fmu):
        self.fmu, self.messages, self.t = fmu, [], 0.0

    def call(self, name, *arguments, pointer=True):
        function = getattr(self.fmu.library, self.p + name)
        function.restype = c.c_int
        return function(*([self.pointer] if pointer else []), *arguments)

    def free(self):
        function = getattr(self.fmu.library, self.p + "FreeInstance")
        function.restype = None
        function(self.pointer)
        self.pointer = None

    def set(self, values):
        array = (c.c_double * len(values))(*values.values())
        return self.set_array(self.fmu.references(list(values)), array)

    def get(self, names=None):
        """Values by name, or a status that is not OK."""
        names = self.fmu.outputs if names is None else names
        array = (c.c_double * len(names))()
        status = self.get_array(self.fmu.references(names), array)
        return dict(zip(names, array)) if status == OK else status

    def go_to(self, t):
        """One step to the time t; the answer of `step`."""
        return self.step(t - self.t)

    # ---- saved states

    def save(self):
        state = c.c_void_p()
        assert self.call("Get" + self.state_name, c.byref(state)) == OK, self.messages
        return state, self.t

    def restore(self, saved):
        self.t = saved[1]
        return self.call("Set" + self.state_name, saved[0])

    def forget(self, saved):
        status = self.call("Free" + self.state_name, c.byref(saved[0]))
        assert not saved[0]
        return status

    def serialize(self, saved):
        size = c.c_size_t()
        assert self.call(f"Serialized{self.state_name}Size", saved[0], c.byref(size)) == OK
        buffer = (c.c_char * size.value)()
        arguments = [saved[0], buffer, size]
        assert self.call("Serialize" + self.state_name, *arguments) == OK
        return bytes(buffer), saved[1]

    def deserialize(self, data):
        """A saved state, or None when it is refused."""
        state = c.c_void_p()
        buffer = (c.c_char * max(1, len(data[0]))).from_buffer_copy(data[0] or b"\0")
        if self.call(self.back_name, buffer, c.c_size_t(len(data[0])), c.byref(state)) != OK:
            return None
        return state, data[1]


class Instance3(Instance):
    p, state_name, back_name = "fmi3", "FMUState", "DeserializeFMUState"
    log_type = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)

    def __init__(self, fmu, name="one", token=None, resources=None, events=False, early=False, logging=True,
                 logger=True, function="InstantiateCoSimulation"):
        super().__init__(fmu)
        self.log = self.log_type(self.take_message) if logger else self.log_type()
        make = getattr(fmu.library, "fmi3" + function)
        make.restype = c.c_void_p
        texts = [t and t.encode() for t in (name, fmu.token if token is None else token,
                                            fmu.resources if resources is None else resources)]
        self.environment = c.c_int(7)
        flags = [c.c_bool(x) for x in (False, logging)]
        last = [c.byref(self.environment), self.log]
        if function == "InstantiateCoSimulation":
            flags += [c.c_bool(events), c.c_bool(early), None, c.c_size_t(0)]
            last += [None]
        self.pointer = c.c_void_p(make(*texts, *flags, *last))

    def take_message(self, environment, status, category, message):
        assert environment == c.addressof(self.environment)
        self.messages.append((status, category.decode(), message.decode()))

    def set_array(self, references, values):
        return self.call("SetFloat64", references, c.c_size_t(len(references)), values, c.c_size_t(len(values)))

    def get_array(self, references, values):
        return self.call("GetFloat64", references, c.c_size_t(len(references)), values, c.c_size_t(len(values)))

    def initialize(self, tolerance=None, start=0.0, stop=None):
        self.t = start
        return self.call("EnterInitializationMode", c.c_bool(tolerance is not None), c.c_double(tolerance or 0),
                         c.c_double(start), c.c_bool(stop is not None), c.c_double(stop or 0))

    def begin(self):
        return self.call("ExitInitializationMode")

    def step(self, h, t=None):
        """status, event, terminate, early; self.t is where it is then."""
        flags = [c.c_bool() for _ in range(3)]
        reached = c.c_double()
        status = self.call("DoStep", c.c_double(self.t if t is None else t), c.c_double(h), c.c_bool(False),
                           *map(c.byref, flags), c.byref(reached))
        if status == OK:
            self.t = reached.value
        return (status, *(flag.value for flag in flags))

    def update(self):
        """status, discrete states need update, terminate, nominals, values, has next event, its time"""
        flags = [c.c_bool() for _ in range(5)]
        time = c.c_double()
        status = self.call("UpdateDiscreteStates", *map(c.byref, flags), c.byref(time))
        return (status, *(flag.value for flag in flags), time.value)

    def handle_event(self):
        """Through the Event Mode."""
        assert self.call("EnterEventMode") == OK, self.messages
        answer = self.update()
        assert answer[0] == OK and not answer[1], answer
        assert self.call("EnterStepMode") == OK, self.messages
        return answer

    def derivative(self, unknowns, knowns, seed, adjoint=False):
        count = len(knowns) if adjoint else len(unknowns)
        answer = (c.c_double * count)()
        seeds = (c.c_double * len(seed))(*seed)
        status = self.call("GetAdjointDerivative" if adjoint else "GetDirectionalDerivative",
                           self.fmu.references(unknowns), c.c_size_t(len(unknowns)),
                           self.fmu.references(knowns), c.c_size_t(len(knowns)),
                           seeds, c.c_size_t(len(seed)), answer, c.c_size_t(count))
        return list(answer) if status == OK else status


class Functions2(c.Structure):
    log_type = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p, c.c_char_p)
    _fields_ = [("logger", log_type), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p),
                ("environment", c.c_void_p)]


class EventInfo2(c.Structure):
    _fields_ = [(name, c.c_int) for name in ("again", "terminate", "nominals", "values", "has_next")] + [("next", c.c_double)]


class Instance2(Instance):
    p, state_name, back_name = "fmi2", "FMUstate", "DeSerializeFMUstate"

    def __init__(self, fmu, name="one", token=None, resources=None, logging=True, logger=True, kind=1, **ignored):
        super().__init__(fmu)
        self.environment = c.c_int(7)
        log = Functions2.log_type(self.take_message) if logger else Functions2.log_type()
        self.functions = Functions2(log, None, None, None, c.addressof(self.environment))
        make = fmu.library.fmi2Instantiate
        make.restype = c.c_void_p
        place = "file://" + re.sub(r"[^/\w.-]", lambda m: "".join(f"%{b:02X}" for b in m[0].encode()),
                                   fmu.resources.rstrip("/"), flags=re.ASCII)
        texts = [t and t.encode() for t in (name, fmu.token if token is None else token,
                                            place if resources is None else resources)]
        self.pointer = c.c_void_p(make(texts[0], kind, texts[1], texts[2], c.byref(self.functions), 0, int(logging)))

    def take_message(self, environment, name, status, category, form, message):
        assert environment == c.addressof(self.environment) and form == b"%s"
        self.messages.append((status, category.decode(), message.decode()))

    def set_array(self, references, values):
        return self.call("SetReal", references, c.c_size_t(len(references)), values)

    def get_array(self, references, values):
        return self.call("GetReal", references, c.c_size_t(len(references)), values)

    def initialize(self, tolerance=None, start=0.0, stop=None):
        self.t = start
        status = self.call("SetupExperiment", int(tolerance is not None), c.c_double(tolerance or 0),
                           c.c_double(start), int(stop is not None), c.c_double(stop or 0))
        return status if status != OK else self.call("EnterInitializationMode")

    def begin(self):
        return self.call("ExitInitializationMode")

    def step(self, h, t=None):
        start = self.t if t is None else t
        status = self.call("DoStep", c.c_double(start), c.c_double(h), 0)
        terminated, reached = c.c_int(), c.c_double()
        if status == OK:
            self.t = start + h
        elif status == DISCARD:
            assert self.call("GetBooleanStatus", 3, c.byref(terminated)) == OK
            assert self.call("GetRealStatus", 2, c.byref(reached)) == OK
            self.t = reached.value
        return status, False, bool(terminated.value), False

    def new_states(self):
        """As Instance3.update."""
        info = EventInfo2()
        status = self.call("NewDiscreteStates", c.byref(info))
        flags = (info.again, info.terminate, info.nominals, info.values, info.has_next)
        return (status, *map(bool, flags), info.next)

    def derivative(self, unknowns, knowns, seed):
        answer = (c.c_double * len(unknowns))()
        seeds = (c.c_double * len(seed))(*seed)
        status = self.call("GetDirectionalDerivative", self.fmu.references(unknowns), c.c_size_t(len(unknowns)),
                           self.fmu.references(knowns), c.c_size_t(len(knowns)), seeds, answer)
        return list(answer) if status == OK else status
