"""Sends two requests with a pause between them, once for each pause that is given, all at the same time.

idle_client.py HOST PORT PATH BODY PAUSE... prints a JSON list of {pause, waited, kept, error}: the seconds that passed
from before the first request to the second, so never less than the server was left waiting; whether the second went
over the first one's connection; why one of them failed (null: none did).
"""
import http.client
import json
import select
import sys
import threading
import time

host, port, path, body = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4]
results = []


def ask(connection):
    connection.request("POST", path, body, {"Content-Type": "application/json"})
    response = connection.getresponse()
    response.read()
    if response.status != 200:
        raise RuntimeError(f"status {response.status}")


def is_closed(sock):
    """As urllib3 does it before it takes a connection out of its pool."""
    return bool(select.select([sock], [], [], 0)[0])


def run(pause):
    connection = http.client.HTTPConnection(host, port, timeout=30)
    result = {"pause": pause, "waited": 0, "kept": False, "error": None}
    try:
        start = time.monotonic()
        ask(connection)
        time.sleep(pause)
        result["kept"] = not is_closed(connection.sock)
        result["waited"] = time.monotonic() - start
        if not result["kept"]:
            connection.close()
        ask(connection)
    except Exception as error:
        result["error"] = repr(error)
    results.append(result)


threads = [threading.Thread(target=run, args=(float(pause),)) for pause in sys.argv[5:]]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print(json.dumps(results))
