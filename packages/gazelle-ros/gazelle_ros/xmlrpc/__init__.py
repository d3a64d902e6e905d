"""XML-RPC (http://xmlrpc.com/spec.md) on the event loop, strict and with limits."""
