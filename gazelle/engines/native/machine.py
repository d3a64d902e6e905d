"""The processor that kernels run on: machine code for it, in memory."""

from __future__ import annotations

import functools
import logging
import threading
import time
from typing import Final

from gazelle.errors import MissingExtraError

try:
    import llvmlite
    import llvmlite.binding as llvm
except ImportError as error:
    raise MissingExtraError("llvmlite", "planar") from error

_LOG: Final = logging.getLogger(__name__)
_PATIENCE: Final = 2.0  # [s]
LOCK = threading.RLock()


class Machine:
    """Compiles and loads.

    Attributes:
        name: What code for this processor must not be mixed up with.
    """

    def __init__(self) -> None:
        llvm.initialize_native_target()
        llvm.initialize_native_asmprinter()
        triple = llvm.get_process_triple()
        cpu, features = llvm.get_host_cpu_name(), llvm.get_host_cpu_features().flatten()
        x86 = triple.startswith(("x86", "i686"))
        target = llvm.Target.from_triple(triple)
        self._target = target.create_target_machine(
            cpu=cpu,
            features=features,
            opt=3,
            reloc="static" if x86 else "default",
            codemodel="jitdefault",
            jit=True,
        )
        module = llvm.parse_assembly("")
        module.triple = triple
        self._engine = llvm.create_mcjit_compiler(module, self._target)
        self._layout = str(self._engine.target_data)
        self._triple = triple
        self._spent = 0.0
        self.name = f"{triple}\n{cpu}\n{features}\n{llvmlite.__version__}"

    def compile(self, text: str) -> bytes:
        """Machine code of a module; where that takes long on the whole, one line says so."""
        began = time.monotonic()
        module = llvm.parse_assembly(text)
        module.triple, module.data_layout = self._triple, self._layout
        options = llvm.create_pipeline_tuning_options(speed_level=3)
        options.loop_vectorization, options.slp_vectorization = True, False
        builder = llvm.create_pass_builder(self._target, options)
        builder.getModulePassManager().run(module, builder)
        code = bytes(self._target.emit_object(module))
        patient = self._spent < _PATIENCE
        self._spent += time.monotonic() - began
        if patient and self._spent >= _PATIENCE:
            _LOG.warning("native code is compiled for this machine, which is done once")
        return code

    def load(self, code: bytes) -> None:
        """Take machine code into memory; what it calls is found later."""
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(code))

    def address(self, symbol: str) -> int:
        """Where a function is."""
        self._engine.finalize_object()
        return int(self._engine.get_function_address(symbol))


@functools.cache
def fuses() -> bool:
    """Whether the processor rounds a product and a sum once, where a kernel lets it."""
    x86 = llvm.get_process_triple().startswith(("x86", "i686"))
    return bool(llvm.get_host_cpu_features().get("fma")) if x86 else True


@functools.cache
def machine() -> Machine:
    """The one there is."""
    return Machine()
