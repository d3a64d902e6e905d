# Written by tools/message_stubs.py from the bundled definitions; not to be edited.
from . import msg as msg
from . import srv as srv
