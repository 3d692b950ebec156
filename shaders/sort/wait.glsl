// Waits until all lanes of the workgroup have come here, and see in shared memory what the others wrote.
void waitForGroup()
{
    memoryBarrierShared();
    barrier();
}
