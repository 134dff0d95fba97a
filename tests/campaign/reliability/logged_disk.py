"""A disk whose writes are logged: one file of a file system in user space (the protocol of /dev/fuse), made a disk by a loop device.

What the kernel sends to the disk is logged in the order of its arrival, with the flushes of the disk's cache between.  after_power_loss() gives
what a disk may hold that lost its power at some moment: all that was written before the last flush, and of what came after it any part, in any
order, blocks torn at sectors.  dm-log-writes logs the same; it needs device-mapper in the kernel.
"""
import ctypes, os, struct, threading

LOOKUP, FORGET, GETATTR, SETATTR, OPEN, READ, WRITE, RELEASE, FSYNC, FLUSH, INIT, INTERRUPT, DESTROY = 1, 2, 3, 4, 14, 15, 16, 18, 20, 25, 26, 36, 38
ENOENT, ENOSYS, MNT_DETACH = 2, 38, 2
WHOLE, FOLDER, SECTOR, NAME = 1 << 17, 1, 4096, b"disk"  # sectors: ext4 itself does not bear a torn one
FOPEN_DIRECT_IO = 1  # no cache between loop device and log
libc = ctypes.CDLL(None, use_errno=True)


class LoggedDisk:
    """Serves FOLDER/disk of `size` bytes from the moment of mount() to close()."""

    def __init__(self, folder, size):
        self.folder, self.path, self.size = folder, os.path.join(folder, "disk"), size
        self.now, self.log = bytearray(size), []
        self.base = bytes(size)

    def mount(self):
        """Whether the system allows it."""
        try:
            self.device = os.open("/dev/fuse", os.O_RDWR)
        except OSError:
            return False
        how = b"fd=%d,rootmode=40000,user_id=%d,group_id=%d" % (self.device, os.getuid(), os.getgid())
        if libc.mount(b"millstand-disk", os.fsencode(self.folder), b"fuse", 0, how) != 0:
            os.close(self.device)
            return False
        threading.Thread(target=self.serve, daemon=True).start()
        return True

    def close(self):
        libc.umount2(os.fsencode(self.folder), MNT_DETACH)

    def begin(self):
        """What is on the disk now is there for good; the log begins."""
        self.base, self.log = bytes(self.now), []

    def after_power_loss(self, length, random):
        """The disk after the first `length` entries of the log."""
        image, pending = bytearray(self.base), []
        for at, data in self.log[:length]:
            if data is None:
                for offset, written in pending:
                    image[offset:offset + len(written)] = written
                pending = []
            else:
                pending.append((at, data))
        share = random.choice((0.0, 0.1, 0.5, 0.9, 1.0))
        random.shuffle(pending)
        for offset, written in pending:
            if random.random() < 0.9:
                if random.random() < share:
                    image[offset:offset + len(written)] = written
            else:  # torn: some of its sectors
                for k in range(0, len(written), SECTOR):
                    sector = written[k:k + SECTOR]
                    if random.random() < 0.5:
                        image[offset + k:offset + k + len(sector)] = sector
        return image

    def serve(self):
        while True:
            try:
                request = os.read(self.device, WHOLE + 4096)
            except OSError:
                return  # unmounted
            _, code, unique, node = struct.unpack_from("<IIQQ", request)
            if code in (FORGET, INTERRUPT):
                continue
            error, answer = self.answer(code, node, request[40:])
            try:
                os.write(self.device, struct.pack("<IiQ", 16 + len(answer), -error, unique) + answer)
            except OSError:
                return
            if code == DESTROY:
                return

    def attributes(self, node):
        mode, size = (0o040755, 0) if node == FOLDER else (0o100600, self.size)
        return struct.pack("<6Q10I", node, size, size // 512, 0, 0, 0, 0, 0, 0, mode, 1, os.getuid(), os.getgid(), 0, 4096, 0)

    def answer(self, code, node, body):
        """Number of the error and what follows the head."""
        if code == INIT:
            major, minor, ahead, _ = struct.unpack_from("<4I", body)
            return 0, struct.pack("<4I2H2I2H8I", 7, min(minor, 31), ahead, 1 << 5, 16, 12, WHOLE, 1, WHOLE // 4096, 0, *[0] * 8)[:64]
        if code == LOOKUP:
            if body.rstrip(b"\0") != NAME:
                return ENOENT, b""
            return 0, struct.pack("<2Q2Q2I", 2, 0, 3600, 3600, 0, 0) + self.attributes(2)
        if code in (GETATTR, SETATTR):
            return 0, struct.pack("<Q2I", 3600, 0, 0) + self.attributes(node)
        if code == OPEN:
            return 0, struct.pack("<QII", 0, FOPEN_DIRECT_IO, 0)
        if code == READ:
            _, offset, size = struct.unpack_from("<QQI", body)
            return 0, bytes(self.now[offset:offset + size])
        if code == WRITE:
            _, offset, size = struct.unpack_from("<QQI", body)
            data = body[40:40 + size]
            self.now[offset:offset + size] = data
            self.log.append((offset, data))
            return 0, struct.pack("<II", size, 0)
        if code == FSYNC:
            self.log.append((0, None))
            return 0, b""
        if code in (RELEASE, FLUSH, DESTROY):
            return 0, b""
        return ENOSYS, b""
